"""Which figures the report has: what each shows, in words too, and the call that draws it."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from jointplay import figures
from jointplay.figures import page
from jointplay.paper import cases, reported
from jointplay.paper.drawings import forces, portraits, responses, tracks
from jointplay.paper.drawings.curves import COLOURS, Compared
from jointplay.paper.size import Size
from jointplay.paper.variants import CONSTANT, Variant
from jointplay.solver.runs.processes import Advance, Call
from jointplay.storage.studies import StudyReader


@dataclass(frozen=True)
class Picture:
    """A figure of the report.

    Parameters
    ----------
    section
        Of the report.
    caption
        Which figure of the publication it stands beside, and of what.
    alternative
        What it shows, for those who cannot see it.
    call
        Draws it and returns the bytes of a PNG file.
    """

    section: str
    caption: str
    alternative: str
    call: Call


def pictures(folder: Path, size: Size) -> list[Picture]:
    """Return all figures, in the order of the report."""
    found: list[Picture] = []
    for index in range(len(reported.document()["sweeps"])):
        found += _sweep(folder, index, size)
    for case in range(len(reported.document()["phase_ranges"])):
        found += _phase(folder, case, size)
    for which in range(len(reported.document()["bifurcation"])):
        found += _diagram(folder, which, size)
    return found


def _sweep(folder: Path, index: int, size: Size) -> Iterator[Picture]:
    """Yield the response, the contact forces and the paths."""
    sweep = reported.document()["sweeps"][index]
    entries = reported.document()["response_peaks"]
    values = ", ".join(_value(entries[case], sweep) for case in sweep["cases"])
    speeds = sorted({entries[case]["omega_over_pi"] for case in sweep["cases"]})
    ideals = [Compared(folder / cases.ideal(one), "ideal", page.BLACK) for one in speeds]
    for number, (what, alternative) in enumerate(
        (
            (
                "the output's response",
                "Displacement, velocity and acceleration over time, drawn over the ideal"
                " mechanism's, then velocity and acceleration in the first 0.4 s; the largest"
                " acceleration of each is circled.",
            ),
            (
                "contact forces",
                "Normal force at joints A and B in the first 0.4 s, one row for each value; the"
                " true peak of each is circled.",
            ),
            (
                "journal paths",
                "Paths of the journals' centres inside the clearance circles of A and B, one row"
                " for each value.",
            ),
        )
    ):
        for slip in size.drawn:
            variant = Variant(CONSTANT, slip)
            runs = [
                Compared(
                    folder / cases.response(case, variant), _value(entries[case], sweep), colour
                )
                for case, colour in zip(sweep["cases"], COLOURS, strict=True)
            ]
            arguments = ((runs, ideals), (runs, cases.JOINTS), (runs, cases.JOINTS))[number]
            function = (_response, _force, _track)[number]
            caption = f"As {sweep['figures'][number]}: {what} at {values}; {variant.label}."
            yield Picture(
                f"sweep-{index}",
                caption,
                f"{alternative} {values}.",
                Call(function, arguments, 1.0),
            )


def _phase(folder: Path, case: int, size: Size) -> Iterator[Picture]:
    entry = reported.document()["phase_ranges"][case]
    start = size.early[0] * 2.0 / entry["omega_over_pi"]
    name = reported.case_name(entry)
    for variant in size.motions:
        stores = (cases.portrait(case, variant), cases.approach(case, variant))
        arguments = (
            folder / stores[0],
            start,
            folder / stores[1],
            folder / cases.settled(case, variant),
        )
        yield Picture(
            f"phase-{case}",
            f"As {' and '.join(entry['figures'])}: {name}; {variant.label}.",
            f"Eccentricity x against its rate at joints A and B, {name}: trajectory in"
            f" revolutions {size.early[0]} to {size.early[1]}, sections once a revolution in"
            f" revolutions {size.early[0]} to {size.settle} and after them.",
            Call(_portrait, (*arguments, cases.JOINTS), 1.0),
        )


def _diagram(folder: Path, which: int, size: Size) -> Iterator[Picture]:
    entry = reported.document()["bifurcation"][which]
    low, high = entry["interval"]
    span = f"{low:g} to {high:g} {entry['unit']}"
    for variant in size.motions:
        yield Picture(
            f"diagram-{which}",
            f"As {' and '.join(entry['figures'])}: {span}; {variant.label}.",
            f"Bifurcation diagram over {span}: eccentricities x and y of joints A and B at"
            " sections once a revolution, coloured by verdict.",
            Call(_bifurcation, (folder / cases.diagram(which, variant),), 2.0),
        )


def _value(entry: dict[str, Any], sweep: dict[str, Any]) -> str:
    setting = sweep["parameter"]
    if setting == "omega_over_pi":
        return f"{reported.turning(entry[setting])} rad/s"
    return (
        f"{entry[setting]:g} {sweep['unit']}" if sweep["unit"] else f"friction {entry[setting]:g}"
    )


def _response(runs: Sequence[Compared], ideals: Sequence[Compared], advance: Advance) -> bytes:
    return responses.draw(runs, ideals)


def _force(runs: Sequence[Compared], joints: Sequence[str], advance: Advance) -> bytes:
    return forces.draw(runs, joints)


def _track(runs: Sequence[Compared], joints: Sequence[str], advance: Advance) -> bytes:
    return tracks.draw(runs, joints)


def _portrait(
    trajectory: Path,
    start: float,
    before: Path,
    after: Path,
    joints: Sequence[str],
    advance: Advance,
) -> bytes:
    return portraits.draw(trajectory, start, before, after, joints)


def _bifurcation(store: Path, advance: Advance) -> bytes:
    return figures.render(StudyReader(store), "bifurcation", "png")
