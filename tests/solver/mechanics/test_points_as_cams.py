"""A cam may be a point: its profile is its lash, and of a roller its radius besides, nowhere less.

Whether a circle of the radius `left` remains is known without any program.
"""

from typing import Any

import pytest
from pydantic import TypeAdapter

from jointplay.solver.joints.flat_follower import FlatFollower
from jointplay.solver.joints.roller_follower import RollerFollower
from tests.solver.cams import follower

ROLLER, LASH = 0.008, 3e-4


def cam(shape: str, left: float) -> Any:
    """Return a round cam of a radius, m, which its follower's profile is about."""
    around = LASH + (ROLLER if shape == "roller" else 0.0)
    profile = {"type": "constant", "value": left + around}
    member = RollerFollower if shape == "roller" else FlatFollower
    return TypeAdapter(member).validate_python(follower(shape, profile, lash=LASH))


@pytest.mark.parametrize("shape", ["flat", "roller"])
@pytest.mark.parametrize("left", [0.0, 1e-6, 0.01])
def test_a_round_cam_is_one_down_to_a_point(shape: str, left: float) -> None:
    assert not list(cam(shape, left).problems())


def test_a_profile_of_amplitude_zero_is_a_circle_whatever_its_frequency() -> None:
    wave = {"type": "sinusoidal", "offset": 0.03, "amplitude": 0.0, "frequency": 1.5}
    flat = TypeAdapter(FlatFollower)
    assert not list(flat.validate_python(follower("flat", wave)).problems())
    lobed = flat.validate_python(follower("flat", wave | {"amplitude": 1e-3}))
    assert [field for field, _ in lobed.problems()] == ["profile"]


@pytest.mark.parametrize("shape", ["flat", "roller"])
@pytest.mark.parametrize("left", [-1e-6, -2e-4])
def test_less_than_a_point_is_no_cam(shape: str, left: float) -> None:
    assert [field for field, _ in cam(shape, left).problems()] == ["clearance/lash"]
