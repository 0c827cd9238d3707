"""A run ends with the step in which it has as many sections at crossings as it shall have."""

import pytest

from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.kernels.loop.runs import SECTIONS, SectionKind
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import Event, LaneProblem
from tests.solver.readable_mechanics import preset


@pytest.mark.parametrize("wanted", [1, 3])
def test_nothing_is_computed_behind_the_step_of_the_last_section(wanted: int) -> None:
    scene = preset("driven-pendulum")
    kernel = ready_kernel(scene, "reduced", "tsitouras")
    event = Event(SectionKind.CROSSING, kernel.rows.index("rod.omega"))
    bundle = Bundle(kernel, [LaneProblem(scene, 1e3, 1e-6, 1e3, 0, wanted, 0.0, event=event)])
    while bundle.advance(10_000):
        pass
    lane, rows = bundle.lane(0), bundle.rows(SECTIONS, 0)
    assert len(rows) == wanted
    last = rows[-1, 0] * float(lane.run["period"]) + rows[-1, 1]
    assert 0.0 <= lane.time - last <= lane.number("tried")
