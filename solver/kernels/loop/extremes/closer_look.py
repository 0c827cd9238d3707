"""Extremes that no scan of step ends finds: in which steps they are sought."""

import numpy as np

from jointplay.solver.kernels.emit.judging import DUE, INSIDE
from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.loop.extremes.bends import find_in_reach, look_between_bends
from jointplay.solver.kernels.loop.extremes.inner_peaks import look_inside
from jointplay.solver.kernels.loop.extremes.inner_states import look_at_inner_states
from jointplay.solver.kernels.loop.extremes.look_about_passages import look_about_fast_passages
from jointplay.solver.kernels.loop.extremes.roughness import is_due
from jointplay.solver.kernels.loop.runs import NO_PAIR
from jointplay.solver.kernels.loop.step import Step


@inner_kernel(forceinline=True)
def look_closer(s: Step) -> None:
    """Seek such extremes in a step that is taken; in steady motion hardly any step has a reason."""
    flag = int(s.work[s.at.flag, s.lane])
    closely = s.at.watched_closely or flag & INSIDE or is_due(s)
    if closely:
        look_about_fast_passages(s)
    if closely or flag & DUE or s.run.landing != NO_PAIR:
        look_inside(s)
    if s.at.inner_states > 0:
        look_at_inner_states(s)
    if s.work[s.at.may_pass_bend, s.lane] > 0.0:
        rows = np.empty(s.at.rows, np.int64)
        look_between_bends(rows[: find_in_reach(s, rows)], 0.0, 1.0, s)
