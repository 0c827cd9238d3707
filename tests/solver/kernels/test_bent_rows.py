"""Channels with a kink where friction bends are those that are looked at from bend to bend."""

import numpy as np
import pytest

from jointplay.solver.integrators import method_for
from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.lane import Lane
from jointplay.solver.lanes.problem import LaneProblem
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.presets import document

NEAR = 1e-3
"""Share of the slip velocity at which friction is full: how far from it slopes are taken."""
STRAIGHT, KINKED = 1e-4, 1e-2
"""Differences between slopes on both sides, in the larger one. What is quadratic in speeds, such as
kinetic energy, differs a little from one side to the other; a kink is a ramp's whole slope."""


@pytest.mark.parametrize("preset", ["slider-crank", "four-bar", "seven-bar-press"])
@pytest.mark.parametrize("formulation", ["reduced", "lagrange"])
def test_channels_have_kinks_at_a_bend_where_their_rows_say_so(
    preset: str, formulation: str
) -> None:
    scene = Scene.model_validate(document(preset))
    kernel = ready_kernel(scene, formulation, method_for("auto", 1e-6))
    bundle = Bundle(kernel, [LaneProblem(scene, 1e9, 1e-6, 1e9, 0, 0, 0.0)])
    lane = bundle.lane(0)
    while not (
        lane["mode"][0] > 0.0 and lane["penetration_rate"][0] < 0.0
    ):  # behind the largest force
        bundle.advance(1)
    lanes = Lane(
        kernel, None, bundle.groups[0].work.copy(), slice(None), bundle.runs[: bundle.width]
    )
    slopes = [slopes_beside_bend(lanes, side) for side in (-1.0, 1.0)]
    scale = np.maximum(*np.abs(slopes))
    difference = np.abs(slopes[1] - slopes[0]) / np.where(scale > 0.0, scale, 1.0)
    bent = np.array(kernel.rows.bent)
    assert bent.any()
    assert not bent.all()
    assert difference[~bent].max() < STRAIGHT
    assert difference[bent].max() > KINKED


def slopes_beside_bend(lanes: Lane, side: float) -> np.ndarray:
    """Return how scanned channels change with a speed, just below or above where friction is full.

    The speed is the coordinate's that changes the first pair's slip most.
    """
    count, states = len(lanes.kernel.coordinates), lanes["y"].copy()
    bend = float(lanes["bend"][0, 0])

    def at(coordinate: int, faster: float) -> tuple[float, np.ndarray]:
        lanes["stage"] = states
        lanes["stage"][count + coordinate] += faster
        lanes.kernel.module.right_hand_side(lanes.work)
        lanes.kernel.module.observe(lanes.work)
        return float(lanes["slip"][0, 0]), lanes["channel"][: len(lanes.kernel.rows.bent), 0].copy()

    slip = at(0, 0.0)[0]
    by = [at(i, 1.0)[0] - slip for i in range(count)]  # slip is linear in speeds
    chosen = int(np.argmax(np.abs(by)))
    near, far = (
        at(chosen, (bend * (1.0 + side * k * NEAR) - slip) / by[chosen])[1] for k in (1e-3, 1.0)
    )
    return (far - near) / side


def test_channels_without_a_kink_are_not_looked_at_from_bend_to_bend() -> None:
    scene = Scene.model_validate(document("four-bar"))
    kernel = ready_kernel(scene, "reduced", method_for("auto", 1e-6))
    looks = []
    for bent in (True, False):
        bundle = Bundle(kernel, [LaneProblem(scene, 1e9, 1e-6, 1e9, 0, 0, 0.0)])
        if not bent:
            bundle.lane(0)["bent"] = 0.0
        before = kernel.module.penetrations_within.call_count
        while bundle.lane(0).steps < 5000:
            bundle.advance(500)
        looks.append(kernel.module.penetrations_within.call_count - before)
    assert looks[0] > looks[1] + 100  # onsets look at gaps, too
