"""Ranges of the phase portraits, in a window soon after the start and in one long after it."""

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Final, NamedTuple

from jointplay.paper import cases, reported
from jointplay.paper.comparison import Cell, Row, signed
from jointplay.paper.variants import Variant
from jointplay.storage.studies import StudyReader

WINDOWS: Final = ("early", "late")


class Quantity(NamedTuple):
    """A quantity of a phase portrait: channel of the joint, words, unit (1e-3 in SI), digits."""

    channel: str
    words: str
    unit: str
    digits: str


QUANTITIES: Final = {
    "x": Quantity("eccentricity_x", "eccentricity x", "mm", ".4f"),
    "v": Quantity("eccentricity_rate_x", "rate x", "mm/s", ".2f"),
}
"""By key of `phase_ranges`."""


class Range(NamedTuple):
    """Smallest and largest value [SI], found between samples too."""

    low: float
    high: float


def found(folder: Path, window: str, variant: Variant, case: int, channel: str) -> Range:
    """Return the range of a channel in an entry of `phase_ranges`."""
    peaks = StudyReader(folder / cases.ranges(window, variant)).peaks(channel)
    return Range(float(peaks.minimum[case]), float(peaks.maximum[case]))


def rows(folder: Path, variants: Sequence[Variant]) -> Iterator[Row]:
    """Compare all ranges; the ratio is that of their widths, in the early window."""
    for case, entry in enumerate(reported.document()["phase_ranges"]):
        for joint in cases.JOINTS:
            for key, (quantity, words, unit, digits) in QUANTITIES.items():
                printed = Range(*entry[joint][key])
                channel = f"{joint}.{quantity}"
                cells = [
                    _cell(
                        printed,
                        found(folder, "early", variant, case, channel),
                        found(folder, "late", variant, case, channel),
                        digits,
                    )
                    for variant in variants
                ]
                pointer = f"/phase_ranges/{case}/{joint}/{key}"
                yield Row(
                    (f"{pointer}/0", f"{pointer}/1"),
                    reported.case_name(entry),
                    f"{words} at {joint}, {unit}",
                    _shown(printed, digits),
                    tuple(cells),
                    ("window", "slip", "contact"),
                )


def _cell(printed: Range, early: Range, late: Range, digits: str) -> Cell:
    ratio = (early.high - early.low) / (printed.high - printed.low)
    return Cell(_shown(early, digits), (f"late {_shown(late, digits)}",), ratio)


def _shown(one: Range, digits: str) -> str:
    low, high = (signed(1e3 * value, digits) for value in one)
    return f"{low} … {high}"
