"""When a gap opened last, whatever happened since: periods turn over, other gaps open."""

import math

from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import LaneProblem
from tests.solver.readable_mechanics import preset

PERIODS, SPEED = 12, 25.0


def test_a_gap_that_is_open_was_closed_until_its_last_contact_ended() -> None:
    scene = preset("impact-oscillator", speed=SPEED)
    problem = LaneProblem(scene, PERIODS * 2.0 * math.pi / SPEED, 1e-6, 1.0, 1, 0, 0.0)
    bundle = Bundle(ready_kernel(scene, "minimal", "tsitouras"), [problem])
    lane, released, compared = bundle.lane(0), {}, 0
    while bundle.advance(3):
        for contact in bundle.impacts(0):
            released[int(contact["joint"])] = float(contact["release"])
        now = lane.run["periods"] * lane.run["period"]
        for pair, release in released.items():
            if lane["mode"][pair] == 0.0:
                # a share of the period is rounded at 1e-16 of all time
                assert math.isclose(now + lane["opened"][pair], release, abs_tol=1e-12)
                compared += lane["opened"][pair] < 0.0
    assert compared > 0
