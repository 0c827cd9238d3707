"""Computations of the points of each kind of job: what a worker needs, and the API never loads.

What jobs of a kind are, their axes and outputs stands in `solver.kinds`, under the same names.
"""

from collections.abc import Callable, Iterator
from typing import Any, Protocol

from jointplay.records.point import StudySlice
from jointplay.solver.calibration.run import CalibrationRun
from jointplay.solver.continuation.run import ContinuationRun
from jointplay.solver.runs.study.plan import Study
from jointplay.solver.runs.study.refined_run import RefinedRun
from jointplay.solver.runs.study.run import StudyRun
from jointplay.solver.runs.work_precision.run import WorkPrecisionRun


class Computation(Protocol):
    """One block of a study, computed in slices."""

    @property
    def seconds(self) -> float:
        """Spent computing by this process since this object was made, without compiling."""

    @property
    def steps(self) -> float:
        """Accepted steps since this object was made."""

    def slices(self) -> Iterator[StudySlice]:
        """Yield what each slice computed, until every point of the block has ended."""

    def checkpoint(self) -> bytes:
        """Return a restart point, from which the same bits follow; valid between slices."""


COMPUTATIONS: dict[str, Callable[[Any, int, bytes | None], Computation]] = {
    "accuracy-study": WorkPrecisionRun,
    "calibration": CalibrationRun,
    "continuation": ContinuationRun,
}
"""By kind, of those whose points are no runs of one mechanism each, eight lanes side by side."""


def computation_of(study: Study, block: int, checkpoint: bytes | None = None) -> Computation:
    """Return the computation of a block, from where a restart point was made if there is one.

    Its slices raise LimitExceeded if the scene's equations are too long to compile.
    """
    run = RefinedRun if study.refine else COMPUTATIONS.get(study.kind, StudyRun)
    return run(study, block, checkpoint)
