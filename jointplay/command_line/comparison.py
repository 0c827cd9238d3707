"""A scene's reported numbers beside ours: which jobs they need, and the table."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from jointplay.command_line.output import aligned

if TYPE_CHECKING:
    from jointplay.client import Peak

SAMPLES = 10_000  # of each case: fine enough that figures show the impacts


@dataclass(frozen=True)
class Case:
    """One job of the comparison, and the numbers that the scene's source prints for it."""

    parameters: dict[str, float | str]
    duration: float
    reported: list[dict[str, Any]]

    @property
    def label(self) -> str:
        """Short name, such as ``clearance=0.0003 friction=0.01``."""
        return " ".join(
            f"{name}={value:g}" if isinstance(value, float) else f"{name}={value}"
            for name, value in self.parameters.items()
        )

    @property
    def folder(self) -> str:
        """The label as the name of a folder."""
        return self.label.replace(" ", "_") or "defaults"

    def job(self, preset: str) -> dict[str, Any]:
        """Return the job document."""
        scene = {"preset": preset, "parameters": self.parameters}
        return {
            "kind": "simulate",
            "scene": scene,
            "duration": self.duration,
            "output_step": self.duration / SAMPLES,
            "label": self.label,
        }


def cases_of(scene: Mapping[str, Any]) -> list[Case]:
    """Group a scene's reported numbers by the job that computes them."""
    cases: dict[tuple[object, ...], Case] = {}
    for entry in scene.get("reported", []):
        key = (*sorted(entry["parameters"].items()), entry["duration"])
        case = Case(entry["parameters"], entry["duration"], [])
        cases.setdefault(key, case).reported.append(entry)
    return list(cases.values())


def document(cases: Sequence[Case], peaks: Sequence[Mapping[str, "Peak"]]) -> list[dict[str, Any]]:
    """Return every reported number beside ours.

    Parameters
    ----------
    cases
        What was run.
    peaks
        The peaks of each case by channel.
    """
    return [
        {
            "where": entry["where"],
            "parameters": case.parameters,
            "channel": entry["channel"],
            "statistic": entry["statistic"],
            "unit": entry["unit"],
            "reported": entry["value"],
            "ours": getattr(found[entry["channel"]], entry["statistic"]),
            "note": entry.get("note", ""),
        }
        for case, found in zip(cases, peaks, strict=True)
        for entry in case.reported
    ]


def table(cases: Sequence[Case], peaks: Sequence[Mapping[str, "Peak"]]) -> list[str]:
    """Return the lines of the table, and the notes below it; arguments as for `document`."""
    rows = [("source", "case", "quantity", "reported", "ours", "ours/reported", "")]
    notes: list[str] = []
    labels = [case.label for case in cases for _ in case.reported]
    for label, entry in zip(labels, document(cases, peaks), strict=True):
        ours, note = entry["ours"], entry["note"]
        if note and note not in notes:
            notes.append(note)
        rows.append(
            (
                entry["where"],
                label,
                f"{entry['statistic']} of {entry['channel']} [{entry['unit']}]",
                f"{entry['reported']:g}",
                f"{ours:.6g}",
                f"{ours / entry['reported']:.4f}",
                f"({notes.index(note) + 1})" if note else "",
            )
        )
    return [*aligned(rows)] + [f"({number}) {note}" for number, note in enumerate(notes, 1)]
