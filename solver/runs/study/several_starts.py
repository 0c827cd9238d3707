"""A point that is computed from several starts: each in turn, and the attractors they end on."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.records.attractors import attractors_of
from jointplay.records.cycles import COVARIANCE, INDEPENDENT, MEAN, SPREAD
from jointplay.records.motion import FAILED, UNDECIDED
from jointplay.records.point import PointEnd, PointStatus
from jointplay.records.study import StudyDataset
from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.lanes.problem import LaneStart
from jointplay.solver.nonlinear.verdict import VERDICTS
from jointplay.solver.runs.study.cycles import attributes_of
from jointplay.solver.runs.study.plan import Study
from jointplay.solver.runs.study.point_run import PointRun
from jointplay.solver.runs.study.problem import perturbed

NAMES = sorted(VERDICTS, key=VERDICTS.__getitem__)
COUNT = "attractors"


def from_next_start(study: Study, kernel: Kernel, run: PointRun, end: PointEnd) -> PointRun | None:
    """Return a point's run from its next start, given the end of this one; None after the last."""
    tried = [*run.tried, end]
    if len(tried) >= study.starts:
        return None
    start = LaneStart(perturbed(study, kernel, run.point, len(tried)))
    return PointRun(run.point, run.chain, run.position, start, tried=tried)


def of_all_starts(study: Study, run: PointRun, end: PointEnd) -> PointEnd:
    """Return a point's results: those from the scene's start, and what all starts amount to.

    Motions that failed or that nothing is decided of count as no attractor.
    """
    if study.starts == 1:
        return end
    ends = [*run.tried, end]
    first = ends[0]
    kept = {
        name: value
        for name, value in first.statistics.items()
        if not name.startswith((MEAN, SPREAD, COVARIANCE, INDEPENDENT))
    }
    kept["steps"] = sum(one.statistics["steps"] for one in ends)
    kept[COUNT] = float(_different(study, run.point, ends))
    return replace(first, statistics=kept)


def _different(study: Study, point: int, ends: list[PointEnd]) -> int:
    """Return on how many attractors runs of one point ended."""
    scene, period = study.point_scene(point), float(study.period[point])
    status = [PointStatus.failed if end.code else PointStatus.done for end in ends]
    found = attractors_of(
        StudyDataset(
            attributes={"job": study.job, "states": attributes_of(scene, period)},
            parameters=(),
            values=np.empty((len(ends), 0)),
            status=np.array(status, np.uint8),
            statistics=_columns([end.statistics for end in ends]),
            indicators=_columns([end.indicators for end in ends]),
            verdict_names=NAMES,
        )
    )
    return sum(one.code not in (FAILED, UNDECIDED) for one in found.found)


def _columns(rows: list[Mapping[str, float]]) -> dict[str, Floats]:
    names = dict.fromkeys(name for row in rows for name in row)
    return {name: np.array([row.get(name, np.nan) for row in rows]) for name in names}
