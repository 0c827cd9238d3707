"""Figures of the report: what each shows, in words too, and the call that draws it."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

from jointplay import figures
from jointplay.figures import colours
from jointplay.paper import drawings, reported
from jointplay.paper.cases import Stores
from jointplay.paper.drawings import COLOURS, Compared
from jointplay.paper.variants import CONSTANT, Size, Variant
from jointplay.solver.runs.processes import Advance, Call
from jointplay.storage.studies.reader import StudyReader

_OF_SWEEPS: Final[tuple[tuple[str, str, Callable[..., bytes]], ...]] = (
    (
        "the output's response",
        "Displacement, velocity and acceleration over time, drawn over the ideal mechanism's, then"
        " velocity and acceleration in the first 0.4 s; the largest acceleration of each is"
        " circled.",
        drawings.draw_responses,
    ),
    (
        "contact forces",
        "Normal force at joints A and B in the first 0.4 s, one row for each value; the true peak"
        " of each is circled.",
        drawings.draw_forces,
    ),
    (
        "journal paths",
        "Paths of the journals' centres inside the clearance circles of A and B, one row for each"
        " value.",
        drawings.draw_paths,
    ),
)
"""Figures of each sweep: caption, alternative text, and the function that draws it."""


@dataclass(frozen=True)
class Picture:
    """A figure of the report.

    Parameters
    ----------
    section
        Where it stands: ``sweep-0``, ``phase-0``, ``diagram-0``, with the number of its entry.
    caption
        The figure of the publication it stands beside, and its subject.
    alternative
        A description for those who cannot see it.
    call
        Draws it and returns the bytes of a PNG file.
    """

    section: str
    caption: str
    alternative: str
    call: Call


def pictures(stores: Stores, size: Size) -> list[Picture]:
    """Return all figures, in the order of the report."""
    kinds = {"sweeps": _sweep, "phase_ranges": _phase, "bifurcation": _diagram}
    return [
        picture
        for key, of_kind in kinds.items()
        for index, entry in enumerate(reported.document()[key])
        for picture in of_kind(stores, index, entry, size)
    ]


def _sweep(stores: Stores, index: int, sweep: dict[str, Any], size: Size) -> Iterator[Picture]:
    entries = {case: reported.document()["response_peaks"][case] for case in sweep["cases"]}
    setting = sweep["parameter"]
    names = {case: reported.in_words(setting, entry[setting]) for case, entry in entries.items()}
    values = ", ".join(names.values())
    ideals = [
        Compared(stores.path("ideal", f"{speed:g}pi"), "ideal", colours.GEOMETRY)
        for speed in sorted({entry["omega_over_pi"] for entry in entries.values()})
    ]
    for beside, (what, alternative, draw) in zip(sweep["figures"], _OF_SWEEPS, strict=True):
        for variant in (Variant(CONSTANT, slip) for slip in size.drawn):
            runs = [
                Compared(stores.path("response", case, variant), name, colour)
                for (case, name), colour in zip(names.items(), COLOURS, strict=True)
            ]
            yield Picture(
                f"sweep-{index}",
                f"As {beside}: {what} at {values}; {variant.label}.",
                f"{alternative} {values}.",
                Call(_drawn, (draw, (runs, ideals))),
            )


def _phase(stores: Stores, case: int, entry: dict[str, Any], size: Size) -> Iterator[Picture]:
    name, (first, last) = reported.case_name(entry), size.early
    start = first * 2.0 / entry["omega_over_pi"]
    for variant in size.motions:
        portrait, approach, settled = (
            stores.path(kind, case, variant) for kind in ("portrait", "approach", "settled")
        )
        yield Picture(
            f"phase-{case}",
            f"As {' and '.join(entry['figures'])}: {name}; {variant.label}.",
            f"Eccentricity x against its rate at joints A and B, {name}: trajectory in"
            f" revolutions {first} to {last}, sections once a revolution in"
            f" revolutions {first} to {size.settle} and after them.",
            Call(_drawn, (drawings.draw_portraits, (portrait, start, approach, settled))),
        )


def _diagram(stores: Stores, which: int, entry: dict[str, Any], size: Size) -> Iterator[Picture]:
    low, high = entry["interval"]
    span = f"{low:g} to {high:g} {entry['unit']}"
    for variant in size.motions:
        yield Picture(
            f"diagram-{which}",
            f"As {' and '.join(entry['figures'])}: {span}; {variant.label}.",
            f"Bifurcation diagram over {span}: eccentricities x and y of joints A and B at"
            " sections once a revolution, coloured by verdict.",
            Call(_drawn, (_bifurcation, (stores.path("diagram", which, variant),)), 2.0),
        )


def _bifurcation(store: Path) -> bytes:
    return figures.render(StudyReader(store), "bifurcation", "png")


def _drawn(draw: Callable[..., bytes], arguments: tuple[Any, ...], advance: Advance) -> bytes:
    return draw(*arguments)
