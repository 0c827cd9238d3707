"""Whether the corners of a cell of a map are alike, so that its inside need not be computed."""

from collections.abc import Hashable, Sequence
from itertools import combinations
from math import hypot, isnan

import numpy as np

from jointplay.records.arrays import Flags
from jointplay.records.point import PointEnd
from jointplay.solver.runs.study.plan import Study

APART = 3.0
"""Standard errors by which exponents differ."""


class Likeness:
    """Compares points of a study: by their label, and exponents of what does not recur.

    The label is the verdict, the period, the impacts in it, and how many attractors there are; of a
    failed point it is the reason. The exponents of periodic motions vary smoothly, with errors far
    below that: they are no reason to split a cell.
    """

    def __init__(self, study: Study) -> None:
        self._record = study.record

    def differ(self, cells: Sequence[Sequence[PointEnd]]) -> Flags:
        """Return (cells,) whether the corners of each differ."""
        return np.array([self._differ(corners) for corners in cells], np.bool_)

    def _differ(self, corners: Sequence[PointEnd]) -> bool:
        if len({self._label(end) for end in corners}) > 1:
            return True
        if corners[0].code or _number(corners[0], "period") > 0.0:
            return False
        return any(_apart(*pair) for pair in combinations(corners, 2))

    def _label(self, end: PointEnd) -> Hashable:
        if end.code:
            return end.code
        period = _number(end, "period")
        strikes = tuple(
            round(count * period / self._record)
            for name, count in end.statistics.items()
            # a record that is no longer than two cycles says how many only to one
            if name.endswith(".impacts") and 0.0 < 2.0 * period < self._record
        )
        return end.indicators.get("verdict"), period, strikes, end.statistics.get("attractors")


def _number(end: PointEnd, name: str) -> float:
    """Return an indicator; one that says nothing is 0."""
    value = end.indicators.get(name, 0.0)
    return 0.0 if isnan(value) else value


def _apart(one: PointEnd, other: PointEnd) -> bool:
    """Return whether two exponents differ by three errors; unknown ones do not."""
    values, errors = (
        [end.indicators.get(name, np.nan) for end in (one, other)]
        for name in ("lyapunov", "lyapunov_error")
    )
    return abs(values[0] - values[1]) > APART * hypot(*errors)
