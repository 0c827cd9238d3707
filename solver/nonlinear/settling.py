"""When a motion has forgotten how it started: decided on its section, as it is computed."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import NamedTuple

import numpy as np

from jointplay.records.arrays import Flags, Floats
from jointplay.solver.nonlinear.batch_means import standard_error
from jointplay.solver.nonlinear.estimate import SIGNIFICANT
from jointplay.solver.nonlinear.recurrence import (
    LONGEST,
    largest_extent,
    recurrence_period,
    still_to_come,
)
from jointplay.solver.nonlinear.whole_turns import unwound

SETTLINGS = {"unsettled": 0, "recurrence": 1, "statistics": 2}
"""Codes of settling, as they are stored; a code never changes its meaning."""

EVERY = 16
"""Sections between two looks for a period."""
LOOK_BACK = 2 * LONGEST
"""Sections in which a period must show."""
FIRST_COMPARISON = 128
"""Sections before statistics are compared for the first time …"""
GROWTH = 4.0 / 3.0
"""… and the factor to each next time: few comparisons, so that few agree by chance."""
BLUR = 0.5
"""Sampling error over spread above which a window is too short to have statistics: a drift, one
flank of a slow beat, or the amplitude of a motion that dies out looks like that."""
TINY = float(np.finfo(np.float64).tiny)


@dataclass(frozen=True)
class Settled:
    """End of settling: `code` of `SETTLINGS`, after how many sections, and one sentence."""

    code: int
    count: int
    reason: str


class Settling:
    """Takes the sections of a motion as they come and says when it has settled, and why.

    scale : (d,) what counts as one in each column, positive.
    tolerance : as in `recurrence_period`, in units of `scale`; columns whose mean or spread changes
        by less count as settled.
    most : sections after which it gives up.
    angles : (d,) columns in rad whose whole turns do not count; by default there are none.

    Settled is what

    - recurs: the last 64 sections have a period of at most 21 within the tolerance, and what is
      still to come, if they go on closing in as they did, stays within it too (looked for every 16
      sections); or
    - has steady statistics: with the first quarter of all sections left out, the means and standard
      deviations of the other three agree with each other, in every column, within three sampling
      errors that count correlation (compared at 128 sections and at each 4/3 times as many). Where
      an error is more than half the spread, as in what drifts or dies out, the quarter is too
      short to have statistics, and must agree within the tolerance.

    A chaotic transient looks settled while it lasts.

    The answer depends on the sections alone, not on the portions in which they are fed. A motion
    is taken up again by feeding its `sections` to a new instance.

    Raises
    ------
    ValueError
        If a scale is not positive, the tolerance negative or `most` smaller than one.
    """

    def __init__(
        self, scale: Floats, tolerance: float, most: int = 1000, angles: Flags | None = None
    ) -> None:
        self.scale = np.asarray(scale, np.float64)
        self._angles = np.zeros(len(self.scale), np.bool_) if angles is None else angles
        if not (self.scale > 0.0).all() or not tolerance >= 0.0 or most < 1:
            raise ValueError("scales and `most` must be positive, the tolerance not negative")
        self.tolerance = tolerance
        self.most = most
        self.result: Settled | None = None
        self._sections = np.empty((most, len(self.scale)))
        self._count = 0
        self._next_comparison = FIRST_COMPARISON
        self._last_look = ""

    @property
    def sections(self) -> Floats:
        """All sections (n, d) that counted, in the unit in which they came."""
        return self._sections[: self._count].copy()

    def feed(self, sections: Floats) -> Settled | None:
        """Take the next sections, (k, d). Returns how settling ended, None: not yet.

        Sections after the decision change nothing.

        Raises
        ------
        ValueError
            If a value is not finite.
        """
        if not np.isfinite(sections).all():
            raise ValueError("settling needs finite sections")
        for section in np.asarray(sections, np.float64):
            if self.result is not None:
                break
            self._sections[self._count] = section
            self._count += 1
            self.result = self._look()
        return self.result

    def _look(self) -> Settled | None:
        n = self._count
        code, reason = SETTLINGS["unsettled"], ""
        if n >= LOOK_BACK and n % EVERY == 0:
            reason = self._recurs()
            code = SETTLINGS["recurrence"]
        if not reason and n == self._next_comparison:
            self._next_comparison = math.ceil(GROWTH * n)
            reason = self._steady()
            code = SETTLINGS["statistics"]
        if reason:
            return Settled(code, n, reason)
        if n == self.most:
            why = self._last_look or "too few to see a period or compare statistics"
            return Settled(SETTLINGS["unsettled"], n, f"not settled after {n} sections: {why}")
        return None

    def _last(self, count: int) -> Floats:
        """Return the last sections without whole turns, in units of `scale`."""
        recent = self._sections[self._count - count : self._count]
        return unwound(recent, self._angles) / self.scale

    def _recurs(self) -> str:
        """Say why the motion recurs; empty: it does not."""
        recent = self._last(LOOK_BACK)
        period = recurrence_period(recent, np.ones(len(self.scale)), self.tolerance)
        if period == 0:
            return ""
        coming = still_to_come(recent, period)
        if coming > self.tolerance:
            self._last_look = f"period {period}, but it still has {coming:.2g} of the scale to go"
            return ""
        extent = largest_extent(recent, period)
        return (
            f"the last {LOOK_BACK} sections have period {period} within {extent:.2g} of the scale"
            f" and converge to {coming:.2g}"
        )

    def _steady(self) -> str:
        """Say why the statistics are steady; empty: they are not."""
        length = self._count // 4
        recent = self._last(3 * length)
        windows = [recent[i * length : (i + 1) * length] for i in range(3)]
        changing = _change_between(windows, self.tolerance)
        if changing:
            self._last_look = changing
            return ""
        return f"means and spreads of the last three times {length} sections agree"


def _change_between(windows: Sequence[Floats], tolerance: float) -> str:
    """Return what changes between windows (n, d) of a motion; empty: nothing noticeable.

    The windows follow one another, and any two must agree, in every column: their means and their
    standard deviations within three sampling errors, which count correlation, or within the
    tolerance. Where a sampling error exceeds half the spread, only the tolerance counts.
    """
    for name, statistic in (("mean", _means), ("spread", _spreads)):
        for a, b in combinations([statistic(window) for window in windows], 2):
            sampling = SIGNIFICANT * np.sqrt(a.error * a.error + b.error * b.error)
            allowed = np.maximum(np.where(a.blurred | b.blurred, 0.0, sampling), tolerance)
            excess = np.abs(b.value - a.value) / np.maximum(allowed, TINY)
            column = int(excess.argmax())
            if excess[column] > 1.0:
                length = len(windows[-1])
                return f"the {name} of column {column} still changes over {length} sections"
    return ""


class _Statistic(NamedTuple):
    """A number for each column (d,), its sampling error, and whether that means anything."""

    value: Floats
    error: Floats
    blurred: Flags


def _means(window: Floats) -> _Statistic:
    error = standard_error(window)
    return _Statistic(np.asarray(window.mean(axis=0)), error, error > BLUR * window.std(axis=0))


def _spreads(window: Floats) -> _Statistic:
    """Return standard deviations, by way of the variances."""
    variance = _means((window - window.mean(axis=0)) ** 2)
    spread = np.sqrt(variance.value)
    return _Statistic(
        spread, variance.error / (2.0 * np.where(spread > 0.0, spread, 1.0)), variance.blurred
    )
