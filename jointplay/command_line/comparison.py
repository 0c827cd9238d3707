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
        """Short name."""
        return label(self.parameters)

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


def rows_of(cases: Sequence[Case], peaks: Sequence[Mapping[str, "Peak"]]) -> list[dict[str, Any]]:
    """Return every reported number beside ours; `peaks` are those of each case by channel."""
    return [
        {
            **{name: entry[name] for name in ("where", "channel", "statistic", "unit")},
            "parameters": case.parameters,
            "reported": entry["value"],
            "ours": getattr(found[entry["channel"]], entry["statistic"]),
            "note": entry.get("note", ""),
        }
        for case, found in zip(cases, peaks, strict=True)
        for entry in case.reported
    ]


def table(rows: Sequence[Mapping[str, Any]]) -> list[str]:
    """Return the lines of the table of `rows_of`, and the notes below it."""
    head = ("source", "case", "quantity", "reported", "ours", "ours/reported", "")
    notes = list(dict.fromkeys(row["note"] for row in rows if row["note"]))
    lines = [
        (
            row["where"],
            label(row["parameters"]),
            f"{row['statistic']} of {row['channel']} [{row['unit']}]",
            f"{row['reported']:g}",
            f"{row['ours']:.6g}",
            f"{row['ours'] / row['reported']:.4f}",
            f"({notes.index(row['note']) + 1})" if row["note"] else "",
        )
        for row in rows
    ]
    return [*aligned([head, *lines])] + [
        f"({number}) {note}" for number, note in enumerate(notes, 1)
    ]


def label(parameters: Mapping[str, float | str]) -> str:
    """Return a short name of a case, such as ``clearance=0.0003 friction=0.01``."""
    return " ".join(
        f"{name}={value:g}" if isinstance(value, float) else f"{name}={value}"
        for name, value in parameters.items()
    )
