"""Distance of a run from an impact that it does not have: the largest penetration, apart.

A smooth function of the start, up to where the impact begins. Rows of the run, equally far apart,
tell where a pair comes near; between them the largest is that of a polynomial through five.
"""

import math

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.kernels.loop.bundle import Bundle
from jointplay.solver.kernels.loop.runs import SAMPLES

ROWS = 256
"""Rows of a period: (2 pi / 256)^5 / 100 is 1e-10."""
MOST_ROWS = 2000
"""Rows of a run at most."""
BESIDE = 2
"""Rows beside a contact that are not apart: a short one lies between two."""
FIRST, SECOND = np.array([1.0, -8.0, 0.0, 8.0, -1.0]) / 12.0, np.array([-1.0, 16, -30, 16, -1]) / 12
THIRD, FOURTH = np.array([-1.0, 2.0, 0.0, -2.0, 1.0]) / 2.0, np.array([1.0, -4.0, 6.0, -4.0, 1.0])
"""Derivatives in the middle of five rows, a row apart."""


def rows_of(periods: int) -> int:
    """Return how many rows a run has that lasts so many periods."""
    return min(ROWS * periods, MOST_ROWS)


class Approaches:
    """Collects the rows of a bundle's lanes, and their contacts, while it advances."""

    def __init__(self, bundle: Bundle, lanes: int) -> None:
        """Begin with none."""
        self._bundle = bundle
        names = [f"{pair}.penetration" for pair in bundle.kernel.pairs]
        self._columns = np.array([bundle.kernel.rows.index(name) for name in names], np.int64)
        self._depths: list[list[Floats]] = [[] for _ in range(lanes)]
        self._contacts: list[list[tuple[int, float, float]]] = [[] for _ in range(lanes)]

    def collect(self) -> None:
        """Take what the bundle has handed out in its last call."""
        for lane, depths in enumerate(self._depths):
            rows = self._bundle.rows(SAMPLES, lane)
            if len(rows):
                depths.append(self._bundle.observe(lane, rows, self._columns))
            self._contacts[lane] += [
                (int(one["joint"]), float(one["onset"]), float(one["release"]))
                for one in self._bundle.impacts(lane)
            ]

    def nearest(self, lane: int, interval: float) -> float:
        """Return the largest penetration of a pair apart, in how far that pair moves; NaN: none.

        `interval` : of rows, s.
        """
        depths = np.concatenate(self._depths[lane])
        found = math.nan
        for pair, depth in enumerate(depths.T):
            apart = depth < 0.0
            for _, onset, release in (one for one in self._contacts[lane] if one[0] == pair):
                first = math.floor(onset / interval) - BESIDE + 1
                last = len(depth) if math.isnan(release) else math.ceil(release / interval)
                apart[max(first, 0) : last + BESIDE] = False
            span = float(np.ptp(depth))
            tops = _tops(depth, apart)
            if tops and span > 0.0:
                found = max(tops) / span if math.isnan(found) else max(found, max(tops) / span)
        return found


def _tops(depth: Floats, apart: np.ndarray[tuple[int], np.dtype[np.bool_]]) -> list[float]:
    """Return the tops of a pair's penetration among rows that are apart."""
    inner = depth[2:-2]
    here = apart[2:-2] & (inner >= depth[1:-3]) & (inner > depth[3:-1])
    return [_top(depth[k : k + 5]) for k in np.flatnonzero(here).tolist()]


def _top(five: Floats) -> float:
    """Return the largest value next to the middle of five, by their polynomial."""
    first, second, third, fourth = (
        float(np.sum(one * five)) for one in (FIRST, SECOND, THIRD, FOURTH)
    )
    t = 0.0
    for _ in range(4):
        slope = first + t * (second + t * (third / 2.0 + t * fourth / 6.0))
        bend = second + t * (third + t * fourth / 2.0)
        if not bend < 0.0:
            break
        t = min(max(t - slope / bend, -1.0), 1.0)
    middle = float(five[2])
    return middle + t * (first + t * (second / 2.0 + t * (third / 6.0 + t * fourth / 24.0)))
