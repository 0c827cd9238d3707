"""Whether the corners of a cell of a map are alike, so that its inside need not be computed."""

from collections.abc import Hashable, Mapping, Sequence
from itertools import combinations
from math import hypot, isnan
from typing import Any

import numpy as np

from jointplay.records.arrays import Flags
from jointplay.records.cycles import SAME, cycles_of
from jointplay.records.point import PointEnd
from jointplay.solver.nonlinear.verdict import VERDICTS
from jointplay.solver.runs.study.plan import Study

APART = 3.0
"""Standard errors by which exponents differ."""


class CellSimilarity:
    """Compares points of a study: by their label, and beyond that by what tells motions apart.

    The label is the verdict, the period, the impacts in it, and how many attractors there are; of a
    failed point it is the reason. Chaos, and what is undecided, is apart by its exponent. Those of
    periodic motions vary smoothly, with errors far below that, and so do those of what is carried
    along by drives without a common period; others of quasi-periodic motions are zero, but for the
    length of the record: they are no reason to split a cell, nor are two that are negative.
    Where the study compares cycles, what recurs is apart by means and spreads of its states.
    """

    def __init__(self, study: Study) -> None:
        self._record = study.record
        self._states = study.attributes().get("states")
        """Scales and angles of states, if cycles are compared."""

    def differ(self, cells: Sequence[Sequence[PointEnd]]) -> Flags:
        """Return (cells,) whether the corners of each differ."""
        return np.array([self._differ(corners) for corners in cells], np.bool_)

    def _differ(self, corners: Sequence[PointEnd]) -> bool:
        if len({self._label(end) for end in corners}) > 1:
            return True
        if corners[0].code:
            return False
        if _recurs(corners[0]):
            return self._states is not None and _cycles_apart(self._states, corners)
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


def _recurs(end: PointEnd) -> bool:
    """Return whether a motion rests or repeats itself for good; undecided ones may not."""
    verdict = end.indicators.get("verdict")
    if verdict == VERDICTS["undecided"]:
        return False
    return verdict == VERDICTS["equilibrium"] or _number(end, "period") > 0.0


def _cycles_apart(states: Mapping[str, Any], corners: Sequence[PointEnd]) -> bool:
    """Return whether a cycle differs from the first by more than those of one attractor."""
    names = corners[0].statistics
    numbers = {name: np.array([end.statistics[name] for end in corners]) for name in names}
    cycles = cycles_of(states, numbers, len(corners))
    apart = np.abs(cycles.apart(cycles.features, cycles.features[0]))
    return bool((apart > SAME * cycles.scales).any())


def _number(end: PointEnd, name: str) -> float:
    """Return an indicator; one that says nothing is 0."""
    value = end.indicators.get(name, 0.0)
    return 0.0 if isnan(value) else value


def _apart(one: PointEnd, other: PointEnd) -> bool:
    """Return whether two exponents differ by three errors; unknown ones do not.

    Nor do two that are negative, or two that do not differ from zero.
    """
    if one.indicators.get("verdict") == VERDICTS["quasi-periodic"]:
        return False
    first, second = (
        [end.indicators.get(name, np.nan) for name in ("lyapunov", "lyapunov_error")]
        for end in (one, other)
    )
    signs = [np.sign(value) * (abs(value) > APART * error) for value, error in (first, second)]
    if signs[0] == signs[1] < 1.0:
        return False
    return bool(abs(first[0] - second[0]) > APART * hypot(first[1], second[1]))
