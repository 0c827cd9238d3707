"""Rounding of channels is told from corners, jumps and narrow peaks by how often values turn.

And by how wide it is beside channels of its kind.
"""

import numpy as np
import pytest

from jointplay.solver.kernels.emit.closer_looks import EVERY
from jointplay.solver.kernels.jit import kernel
from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.kernels.loop.extremes.search.rounding import GROWN, ROUNDING, zigzags
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import LaneProblem
from jointplay.solver.scene.channels import channels
from tests.solver.readable_mechanics import preset


@kernel()
def turns(values: np.ndarray) -> bool:
    return bool(zigzags(values, len(values)))


@pytest.mark.parametrize(
    "values",
    [
        [0.0, 1.0, 2.0, 1.0, 0.0],  # a corner
        [0.0, 1.0, 0.9, 0.8, 0.7],  # a steep side
        [0.0, 0.0, 1.0, 0.99, 0.98],  # a jump, and on
        [1.0, 1.1, 1.2, 0.0, 0.0, 0.0],
        [0.0, 0.0, 1.0, 0.0, 0.0],  # a narrow peak
        [0.0, 0.7, 1.0, 0.7, 0.0],
        [0.0, 0.0, 0.0, 0.0, 0.0],
    ],
)
def test_what_turns_once_is_no_rounding(values: list[float]) -> None:
    for sense in (1.0, -1.0):
        assert not turns(sense * np.array(values))
        assert not turns(sense * np.array(values[::-1]))


def test_what_turns_again_is() -> None:
    # a force that nothing carries, N: quarters of a step of the press
    assert turns(np.array([4.6e-14, -3.8e-14, -2.5e-15, -8.6e-15, -8.1e-14, 1e-14]))
    assert turns(np.array([0.0, 1.0, 0.0, 1.0, 0.5]))


def test_a_range_is_rounding_beside_those_of_its_kind_alone() -> None:
    # of a journal of 1000 t in a bearing of 1 um, which its weight of 1e7 N presses in
    scene = preset("bouncing-journal", mass=1e6, clearance=1e-6, gravity_y=-9.81)
    bundle = Bundle(
        ready_kernel(scene, "reduced"), [LaneProblem(scene, 1.0, 1e-6, 1.0, 0, 0, 0.0)], watch=True
    )
    while bundle.lane(0).steps < EVERY:  # until a look inside a step
        bundle.advance(1)
    lane, names = bundle.lane(0), bundle.kernel.rows.watched
    ranges = (lane["highest"] - lane["lowest"])[: len(names)]
    found = dict(zip(names, lane["rounding"], strict=False))
    units = {channel.name: channel.unit for channel in channels(scene)}
    for kind in (("m", "rad"), ("m/s", "rad/s"), ("m/s^2", "rad/s^2"), ("N",), ("J",)):
        of_kind = [units[name] in kind for name in names]
        (least,) = {found[name] for name, one in zip(names, of_kind, strict=True) if one}
        widest = ROUNDING * ranges[of_kind].max()  # noted anew when it has grown by so much
        assert widest / GROWN <= least <= widest, kind
    assert found["bearing.force_y"] > ranges[names.index("bearing.penetration")]
