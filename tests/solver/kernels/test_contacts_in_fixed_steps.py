"""Contacts where steps are fixed: all that close in a step begin at its end."""

import numpy as np

from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import LaneProblem
from jointplay.solver.scene.document import Scene
from tests.solver.sliders import block, thrown

STEP = 1e-6


def test_a_block_that_meets_a_wall_with_two_corners_at_once_does_not_turn() -> None:
    scene = Scene.model_validate(thrown(block(), 0.0, -0.3))
    problem = LaneProblem(scene, 0.02, 1e-6, 1.0, 1, 0, 0.0, step=STEP)
    bundle = Bundle(ready_kernel(scene, "minimal", "rk4"), [problem])
    while bundle.advance(10**6):
        pass
    lane = bundle.lane(0)
    angle, speed = lane["y"][2], lane["y"][5]
    assert lane.run["onsets"] >= 4  # two corners, at one wall and at the other
    # forces of both corners are equal but for the rounding of their places
    assert abs(angle) < 1e-12, angle
    assert abs(speed) < 1e-9, speed
    assert np.isfinite(lane["y"]).all()
