"""Distances of a run from another number of impacts: least gaps, penetrations, and impact speeds.

The largest penetration apart is a smooth function of the start, up to where the impact begins. Rows
of the run, equally far apart, tell where a pair comes near; between them the largest is that of a
polynomial through five.
"""

import math
from typing import NamedTuple

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.kernels.loop.runs import SAMPLES
from jointplay.solver.lanes.bundle import Bundle

ROWS = 256
"""Rows of a period: (2 pi / 256)^5 / 100 is 1e-10."""
MOST_ROWS = 2000
"""Rows of a run at most."""
FINE_ROWS, MOST_FINE_ROWS = 2048, 8192
"""The same where margins are asked for: a journal may swing sixty times in a period."""
CONTACT = ["joint", "onset", "release", "approach_rate"]
BESIDE = 2
"""Rows beside a contact that are not apart: a short one lies between two."""
Mask = np.ndarray[tuple[int], np.dtype[np.bool_]]
FIRST, SECOND = np.array([1.0, -8.0, 0.0, 8.0, -1.0]) / 12.0, np.array([-1.0, 16, -30, 16, -1]) / 12
THIRD, FOURTH = np.array([-1.0, 2.0, 0.0, -2.0, 1.0]) / 2.0, np.array([1.0, -4.0, 6.0, -4.0, 1.0])
"""Derivatives in the middle of five rows, a row apart."""


def rows_of(periods: int) -> int:
    """Return how many rows a run has that lasts so many periods."""
    return min(ROWS * periods, MOST_ROWS)


def fine_rows_of(periods: int) -> int:
    """Return the same where margins are asked for."""
    return min(FINE_ROWS * periods, MOST_FINE_ROWS)


class Margins(NamedTuple):
    """Distances of an orbit from another number of impacts; NaN: none of that kind."""

    gap: float = math.nan
    """Least gap of a pair that comes near and does not touch, m."""
    penetration: float = math.nan
    """Least penetration of a pair that nearly opens and does not, m."""
    speed: float = math.nan
    """Approach rate of the slowest impact, m/s."""


NO_MARGINS = Margins()


class Approaches:
    """Collects the rows of a bundle's lanes, and their contacts, while it advances."""

    def __init__(self, bundle: Bundle, lanes: int) -> None:
        """Begin with none."""
        self._bundle = bundle
        names = [f"{pair}.penetration" for pair in bundle.kernel.pairs]
        self._columns = np.array([bundle.kernel.rows.index(name) for name in names], np.int64)
        self._depths: list[list[Floats]] = [[] for _ in range(lanes)]
        self._contacts: list[list[tuple[int, float, float, float]]] = [[] for _ in range(lanes)]

    def collect(self) -> None:
        """Take what the bundle has handed out in its last call."""
        for lane, depths in enumerate(self._depths):
            rows = self._bundle.rows(SAMPLES, lane)
            if len(rows):
                depths.append(self._bundle.observe(lane, rows, self._columns))
            self._contacts[lane] += [
                (int(pair), float(onset), float(release), float(rate))
                for pair, onset, release, rate in self._bundle.impacts(lane)[CONTACT].tolist()
            ]

    def nearest(self, lane: int, interval: float) -> float:
        """Return the largest penetration of a pair apart, in how far that pair moves; NaN: none.

        `interval` : of rows, s.
        """
        found = math.nan
        for pair, depth in enumerate(np.concatenate(self._depths[lane]).T):
            span = float(np.ptp(depth))
            tops = _tops(depth, self._apart(lane, pair, depth, interval))
            if tops and span > 0.0:
                found = max(tops) / span if math.isnan(found) else max(found, max(tops) / span)
        return found

    def margins(self, lane: int, interval: float) -> Margins:
        """Return how far a run that is back at its end is from another number of impacts.

        `interval` : of rows, s.
        """
        gaps, depths = list[float](), list[float]()
        for pair, depth in enumerate(np.concatenate(self._depths[lane]).T):
            apart = self._apart(lane, pair, depth, interval)
            pressed = self._pressed(lane, pair, depth, interval)
            for mask in (apart, pressed):  # its end is its start
                mask[0] &= mask[-1]
            again = np.arange(-2, len(depth) + 1) % (len(depth) - 1)
            gaps += [-top for top in _tops(depth[again], apart[again])]
            depths += [-top for top in _tops(-depth[again], pressed[again])]
        gap, penetration = min(gaps, default=math.nan), min(depths, default=math.nan)
        return Margins(gap, penetration, self.slowest(lane))

    def slowest(self, lane: int) -> float:
        """Return the approach rate of a lane's slowest impact, m/s; NaN: none."""
        rates = (rate for _, onset, _, rate in self._contacts[lane] if onset > 0.0)
        return min(rates, default=math.nan)

    def _apart(self, lane: int, pair: int, depth: Floats, interval: float) -> Mask:
        """Return at which rows a pair is apart, and not beside a contact."""
        apart = depth < 0.0
        for _, onset, release, _ in (one for one in self._contacts[lane] if one[0] == pair):
            first = math.floor(onset / interval) - BESIDE + 1
            last = len(depth) if math.isnan(release) else math.ceil(release / interval)
            apart[max(first, 0) : last + BESIDE] = False
        return apart

    def _pressed(self, lane: int, pair: int, depth: Floats, interval: float) -> Mask:
        """Return at which rows a pair is in contact, and not beside its beginning or end."""
        pressed = depth > 0.0
        for _, onset, release, _ in (one for one in self._contacts[lane] if one[0] == pair):
            for end in (one for one in (onset, release) if one > 0.0):
                first = math.floor(end / interval) - BESIDE + 1
                pressed[max(first, 0) : math.ceil(end / interval) + BESIDE] = False
        return pressed


def _tops(depth: Floats, among: Mask) -> list[float]:
    """Return the tops of a pair's penetration among some rows."""
    inner = depth[2:-2]
    here = among[2:-2] & (inner >= depth[1:-3]) & (inner > depth[3:-1])
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
