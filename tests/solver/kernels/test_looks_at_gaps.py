"""Gaps at the ends of a step's eighths are evaluated once, however many pairs ask for them."""

import pytest

from jointplay.solver.kernels.jit import kernel
from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.kernels.loop.onset import forget_looks, look_at_eighths, look_between
from jointplay.solver.kernels.loop.step import Workspace, group_of, step_of
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import LaneProblem
from tests.solver.readable_mechanics import preset


@kernel()
def look_twice(given: Workspace, finer: bool, anew: bool) -> None:
    """Look at the step of lane 0, and again after a finer look, or in another step."""
    s = step_of(0, group_of(given))
    forget_looks(s)
    look_at_eighths(s)
    if finer:
        look_between(0.0, 0.5, s)
    if anew:
        forget_looks(s)
    look_at_eighths(s)


@pytest.mark.parametrize(
    ("finer", "anew", "evaluated"), [(False, False, 1), (True, False, 3), (False, True, 2)]
)
def test_a_look_is_taken_again_only_where_it_is_not_the_last(
    finer: bool, anew: bool, evaluated: int
) -> None:
    scene = preset("bouncing-journal")
    journal = ready_kernel(scene, "reduced", "tsitouras")
    bundle = Bundle(journal, [LaneProblem(scene, 1.0, 1e-6, 1.0, 0, 0, 0.0)])
    bundle.advance(5)
    before = journal.module.penetrations_within.call_count
    look_twice(bundle.workspace(bundle.groups[0]), finer, anew)
    assert journal.module.penetrations_within.call_count - before == evaluated
