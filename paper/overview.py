"""How near each reading of the publication comes to what it prints, in one line each."""

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, Final, NamedTuple

import numpy as np

from jointplay.paper import cases, ranges, reported
from jointplay.paper.peaks import Extreme, extreme
from jointplay.paper.variants import Variant
from jointplay.storage.results import ResultReader

IMPACTS: Final = {
    "acceleration": "acceleration",
    "force_A": "A.normal_force",
    "force_B": "B.normal_force",
}
"""By key of `response_peaks`: channels whose peaks are those of impacts."""
TITLES: Final = (
    "reading",
    "displacement, largest difference",
    "same impact",
    "their peaks, ours over printed",
    "all peaks of impacts",
    "widths in x",
    "widths of rates",
)


class Timed(NamedTuple):
    """A printed peak of an impact, with its time [s] if that is printed, and ours."""

    printed: float
    time: float | None
    ours: Extreme

    @property
    def ratio(self) -> float:
        """Ours, sampled like theirs, over the printed one."""
        return abs(self.ours.sampled) / self.printed

    @property
    def same_impact(self) -> bool:
        """Both fall on the same instant of the publication's grid, or on neighbours."""
        grid = float(reported.document()["grid"])
        return self.time is not None and abs(self.ours.sampled_time - self.time) < 1.5 * grid


def impacts(folder: Path, variant: Variant) -> list[Timed]:
    """Return all printed peaks of impacts."""
    return [
        Timed(*_printed(entry, key), peak(folder, case, variant, channel))
        for case, entry in enumerate(reported.document()["response_peaks"])
        for key, channel in IMPACTS.items()
    ]


def strokes(folder: Path, variant: Variant) -> list[float]:
    """Return by how much [m] the peaks of the displacement differ from the printed ones."""
    return [
        abs(peak(folder, case, variant, "displacement").value - 1e-3 * entry["displacement_mm"])
        for case, entry in enumerate(reported.document()["response_peaks"])
        if "displacement_mm" in entry
    ]


def peak(folder: Path, case: int, variant: Variant, channel: str) -> Extreme:
    """Return the extreme of a channel in an entry of `response_peaks`."""
    return extreme(ResultReader(folder / cases.response(case, variant)), channel)


def rows(folder: Path, variants: Sequence[Variant]) -> Iterator[tuple[str, ...]]:
    """Yield a line for each variant, in the order of `TITLES`."""
    for variant in variants:
        found = impacts(folder, variant)
        timed = [one for one in found if one.time is not None]
        same = [one for one in timed if one.same_impact]
        yield (
            variant.label,
            f"{1e3 * max(strokes(folder, variant)):.2f} mm",
            f"{len(same)} of {len(timed)}",
            _spread([one.ratio for one in same]),
            _spread([one.ratio for one in found]),
            *(_spread(_widths(folder, variant, key)) for key in ranges.QUANTITIES),
        )


def _widths(folder: Path, variant: Variant, key: str) -> list[float]:
    """Return the widths of ranges in the early window over the printed ones."""
    ratios = []
    for case, entry in enumerate(reported.document()["phase_ranges"]):
        for joint in cases.JOINTS:
            low, high = entry[joint][key]
            channel = f"{joint}.{ranges.QUANTITIES[key].channel}"
            ours = ranges.found(folder, "early", variant, case, channel)
            ratios.append((ours.high - ours.low) / (high - low))
    return ratios


def _spread(ratios: Sequence[float]) -> str:
    if not ratios:
        return "none"
    return f"×{np.median(ratios):.2f} ({min(ratios):.2f} … {max(ratios):.2f})"


def _printed(entry: dict[str, Any], key: str) -> tuple[float, float | None]:
    value = entry[key]
    if isinstance(value, list):
        return value[0], value[1]
    return value, entry.get(f"{key}_time")
