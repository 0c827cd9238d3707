"""Ranges of the phase portraits, in a window soon after the start and in one long after it."""

from collections.abc import Iterator, Sequence
from typing import Final, NamedTuple

from jointplay.paper import cases, reported
from jointplay.paper.cases import Stores
from jointplay.paper.comparison import Cell, Row, signed
from jointplay.paper.variants import Variant

WINDOWS: Final = ("early", "late")
QUANTITIES: Final = {
    "x": ("eccentricity_x", "eccentricity x", "mm", ".4f"),
    "v": ("eccentricity_rate_x", "rate x", "mm/s", ".2f"),
}
"""By key of `phase_ranges`: channel of the joint, words, unit (1e-3 in SI), digits."""


class Range(NamedTuple):
    """Smallest and largest value [SI], found between samples too."""

    low: float
    high: float

    @property
    def width(self) -> float:
        """Largest less smallest value."""
        return self.high - self.low


def found(stores: Stores, window: str, variant: Variant, case: int, joint: str, key: str) -> Range:
    """Return the range of a quantity in an entry of `phase_ranges`."""
    peaks = stores.study("ranges", window, variant).peaks(f"{joint}.{QUANTITIES[key][0]}")
    return Range(float(peaks.minimum[case]), float(peaks.maximum[case]))


def rows(stores: Stores, variants: Sequence[Variant]) -> Iterator[Row]:
    """Compare all ranges; the ratio is that of their widths, in the early window."""
    for case, entry in enumerate(reported.document()["phase_ranges"]):
        for joint in cases.JOINTS:
            for key, (_, words, unit, digits) in QUANTITIES.items():
                printed, cells = Range(*entry[joint][key]), []
                for variant in variants:
                    early, late = (found(stores, one, variant, case, joint, key) for one in WINDOWS)
                    details = (f"late {_shown(late, digits)}",)
                    cells.append(Cell(_shown(early, digits), details, early.width / printed.width))
                pointer = f"/phase_ranges/{case}/{joint}/{key}"
                yield Row(
                    (f"{pointer}/0", f"{pointer}/1"),
                    reported.case_name(entry),
                    f"{words} at {joint}, {unit}",
                    _shown(printed, digits),
                    tuple(cells),
                    ("window", "slip", "contact"),
                )


def widths(stores: Stores, variant: Variant, key: str) -> list[float]:
    """Return the widths of ranges in the early window over the printed ones."""
    return [
        found(stores, "early", variant, case, joint, key).width / Range(*entry[joint][key]).width
        for case, entry in enumerate(reported.document()["phase_ranges"])
        for joint in cases.JOINTS
    ]


def _shown(one: Range, digits: str) -> str:
    low, high = (signed(1e3 * value, digits) for value in one)
    return f"{low} … {high}"
