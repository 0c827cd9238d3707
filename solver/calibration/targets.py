"""Misses of the targets, in units of each target's tolerance."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.records.failure import Problem
from jointplay.solver.calibration.document import CalibrationTarget

DEFAULT_TOLERANCE = 0.05
"""Relative: peaks of impacts are hardly known better."""
MOST_SAMPLES = 100_000
"""Instants of a grid that a target is read off."""
MOST_FROM_START = 1_000_000
"""The same from the start of the run on, of which all are kept."""


@dataclass(frozen=True, eq=False)
class Goals:
    """The targets of all cases as columns.

    Attributes
    ----------
    low, high : (targets,) float
        Between which every value is as good as any; equal for a single value.
    tolerance : (targets,) float
        What counts as a miss of one, in the unit of each.
    weight : (targets,) float
        Of the squared misses; zero where a target is only shown.
    """

    low: Floats
    high: Floats
    tolerance: Floats
    weight: Floats

    def misses(self, values: Floats) -> Floats:
        """Return (n, targets): how far values are off, in tolerances, with their sign."""
        below = np.minimum(values - self.low, 0.0)
        above = np.maximum(values - self.high, 0.0)
        return np.asarray((below + above) / self.tolerance, np.float64)

    def costs(self, values: Floats) -> Floats:
        """Return (n,): weighted root mean square of the misses; infinite where a run failed."""
        fitted = self.weight > 0.0
        squares = self.weight[fitted] * self.misses(values)[:, fitted] ** 2
        cost = np.sqrt(squares.sum(axis=1) / self.weight.sum())
        return np.where(np.isnan(cost), np.inf, cost)


def goals_of(targets: Sequence[CalibrationTarget]) -> Goals:
    """Return the columns of checked targets."""
    columns = [(*_limits(target), tolerance_of(target), target.weight) for target in targets]
    return Goals(*np.array(columns, np.float64).T)


def tolerance_of(target: CalibrationTarget) -> float:
    """Return what counts as a miss of one, in the target's unit; zero if it is undetermined."""
    if target.absolute_tolerance is not None:
        return target.absolute_tolerance
    given = [target.value] if target.between is None else target.between
    size = max((abs(value) for value in given if value is not None), default=0.0)
    return size * (target.relative_tolerance or DEFAULT_TOLERANCE)


def target_problems(target: CalibrationTarget, pointer: str) -> Iterator[Problem]:
    """Yield what is wrong with a target, whatever the scene."""
    if (target.value is None) == (target.between is None):
        both = ", not both." if target.between is not None else "."
        yield Problem(f"{pointer}/value", f"Give one of 'value' and 'between'{both}")
        return
    low, high = _limits(target)
    if not (low <= high and (np.isfinite(low) or np.isfinite(high))):
        sentence = "'between' is [lowest, highest], in that order; one of them may be null."
        yield Problem(f"{pointer}/between", sentence)
    elif target.relative_tolerance is not None and target.absolute_tolerance is not None:
        sentence = "Give a relative tolerance or an absolute one, not both."
        yield Problem(f"{pointer}/absolute_tolerance", sentence)
    elif not tolerance_of(target) > 0.0:
        sentence = "A share of zero is zero; give an 'absolute_tolerance'."
        yield Problem(f"{pointer}/absolute_tolerance", sentence)
    if not target.start < target.stop:
        sentence = f"The window ends at {target.stop:g} s, before it begins ({target.start:g} s)."
        yield Problem(f"{pointer}/to", sentence)
    elif target.sampled is not None:
        yield from _grid_problems(target, target.sampled, pointer)


def _grid_problems(target: CalibrationTarget, step: float, pointer: str) -> Iterator[Problem]:
    within, before = (target.stop - target.start) / step, target.stop / step
    if not within <= MOST_SAMPLES:
        sentence = f"These are {within:.6g} instants; read off at most {MOST_SAMPLES}."
        yield Problem(f"{pointer}/sampled", sentence)
        return
    if before > MOST_FROM_START:
        sentence = (
            f"The grid has {before:.6g} instants until {target.stop:g} s, and {MOST_FROM_START} at"
            " most are kept; give a coarser one, or an earlier window."
        )
        yield Problem(f"{pointer}/sampled", sentence)
        return
    count = len(grid_indices(target.start, target.stop, step))
    if count < (2 if target.statistic == "range" else 1):
        sentence = (
            f"The window has {count or 'no'} multiple of {step:g} s in it; give a longer one."
        )
        yield Problem(f"{pointer}/sampled", sentence)


def grid_indices(start: float, stop: float, step: float) -> range:
    """Return k of the instants k * step in a window; its ends count, but for rounding."""
    first, last = start / step, stop / step
    return range(int(np.ceil(first * (1.0 - 1e-12))), int(np.floor(last * (1.0 + 1e-12))) + 1)


def _limits(target: CalibrationTarget) -> tuple[float, float]:
    if target.between is None:
        value = 0.0 if target.value is None else target.value
        return value, value
    low, high = target.between
    return (-np.inf if low is None else low), (np.inf if high is None else high)
