"""A few instants of a run that has ended, as close to each other as one likes."""

import numpy as np
from numpy.typing import NDArray

from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.kernels.loop.runs import SAMPLES
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import LaneProblem
from jointplay.solver.runs.admission import Admission

PIECE = 1000
"""Attempts at a step between two looks at the time."""


def close_look(
    admission: Admission, method: str, first: float, spacing: float, count: int
) -> NDArray[np.float64]:
    """Compute a run again and return channels at instants from `first` on, (count, channels).

    method : what the whole run was computed with; which instants are handed out changes nothing.
    """
    job, index = admission.job, int(first / spacing)
    problem = LaneProblem(
        admission.scene,
        job["duration"],
        admission.tolerance,
        spacing,
        samples=index + count + 1,
        sections=0,
        section_offset=0.0,
        step=job["step"],
        first_sample=index,
    )
    kernel = ready_kernel(problem.scene, job["formulation"], method)
    bundle = Bundle(kernel, [problem], watch=False)
    columns = np.array([kernel.rows.index(c.name) for c in admission.channels], dtype=np.int64)
    found = [np.empty((0, len(columns)))]
    while bundle.lane(0).running and sum(map(len, found)) < count:
        bundle.advance(PIECE)
        found.append(bundle.observe(0, bundle.rows(SAMPLES, 0), columns))
    return np.concatenate(found)[:count]
