"""The publication's comparison of two programs, against ours under three gravities."""

from collections.abc import Iterator
from pathlib import Path
from typing import Final

from jointplay.paper import cases, reported
from jointplay.paper.comparison import Cell, Row, milliseconds, signed
from jointplay.paper.peaks import Extreme, extreme
from jointplay.paper.variants import Variant
from jointplay.storage.results import ResultReader

PROGRAMS: Final = {"matlab": "their program", "adams": "ADAMS"}


def stroke(folder: Path, gravity: str, variant: Variant) -> float:
    """Return the peak of the displacement [m] under a gravity of `cases.GRAVITIES`."""
    return _found(folder, gravity, variant, "displacement").value


def nearest(folder: Path, program: str, variant: Variant) -> str:
    """Return the gravity under which our displacement comes nearest to a program's."""
    printed = reported.document()["adams_comparison"]["displacement_m"][program]
    return min(cases.GRAVITIES, key=lambda one: abs(stroke(folder, one, variant) - printed))


def rows(folder: Path, variant: Variant) -> Iterator[Row]:
    """Compare both programs' peaks; the columns are the gravities, of one variant."""
    entry = reported.document()["adams_comparison"]
    name = reported.case_name(entry)
    for program, words in PROGRAMS.items():
        printed = entry["displacement_m"][program]
        found = [_found(folder, gravity, variant, "displacement") for gravity in cases.GRAVITIES]
        cells = [Cell(f"{1e3 * one.value:.2f}", (), None) for one in found]
        pointer = f"/adams_comparison/displacement_m/{program}"
        shown = f"{1e3 * printed:.1f}"
        yield Row(
            (pointer,), name, f"displacement by {words}, mm", shown, tuple(cells), ("gravity",)
        )
    for program, words in PROGRAMS.items():
        peak, time = entry["acceleration"][program]
        found = [_found(folder, gravity, variant, "acceleration") for gravity in cases.GRAVITIES]
        pointer = f"/adams_comparison/acceleration/{program}"
        yield Row(
            (f"{pointer}/0", f"{pointer}/1"),
            name,
            f"acceleration by {words}, m/s²",
            f"{peak:g} at {milliseconds(time)}",
            tuple(_cell(one) for one in found),
            ("gravity", "sampling", "order"),
        )


def _cell(found: Extreme) -> Cell:
    return Cell(
        f"{signed(found.value, '.4g')} at {milliseconds(found.time)}",
        (f"sampled {signed(found.sampled, '.4g')} at {milliseconds(found.sampled_time)}",),
    )


def _found(folder: Path, gravity: str, variant: Variant, channel: str) -> Extreme:
    return extreme(ResultReader(folder / cases.load_case(gravity, variant)), channel)
