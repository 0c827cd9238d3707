"""The part that is computed of points under way: for progress, no result depends on it."""

from collections.abc import Sequence

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.runs.study.finer import COST, periods_of
from jointplay.solver.runs.study.plan import Study
from jointplay.solver.runs.study.point_run import PointRun


def part_computed(study: Study, runs: Sequence[PointRun], now: Floats, until: Floats) -> float:
    """Return how many points the parts amount to, counted in steps of their records.

    Parameters
    ----------
    runs
        Points under way.
    now, until
        (runs,) s: times that they have reached, and that their lanes run to.
    """
    points = [run.point for run in runs]
    whole = study.duration[points]
    full = whole.copy()
    if study.carries_exponents:
        full += COST * periods_of(study.record) * study.period[points]
    behind = np.array([run.ended is not None for run in runs], np.bool_)  # their records
    left = np.maximum(full - COST * (until - now), 0.0)
    computed = np.where(behind, left, np.minimum(now, whole)) / full
    return float(sum(len(run.tried) for run in runs) + computed.sum()) / study.starts
