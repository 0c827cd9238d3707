"""Names: a body may be called as a joint or another part; all else has a name of its own."""

import json
from typing import Any

import numpy as np
import pytest

from jointplay.records.failure import InvalidInput
from jointplay.solver.kinds import admit
from tests.solver.cams import follower, pitch_table, valve
from tests.solver.completed_runs import run


def named(cam: str, joint: str) -> dict[str, Any]:
    """Return a valve whose cam, and the joint on it, have these names."""
    scene = json.dumps(valve(follower("roller", pitch_table(24), lash=1e-4)))
    found: dict[str, Any] = json.loads(scene.replace("shaft", cam))
    joints = found["joints"]
    joints[joint] = joints.pop("cam")
    return found


def test_a_body_may_have_the_name_of_the_joint_on_it() -> None:
    shared, apart = (run(named("cam", joint), 0.02) for joint in ("cam", "lobe"))
    assert "cam.theta" in shared.samples
    assert "cam.normal_force" in shared.samples
    for channel, values in apart.samples.items():
        same = channel.replace("lobe.", "cam.")
        np.testing.assert_array_equal(shared.samples[same], values)


def test_a_section_of_its_angle_is_one_of_the_body() -> None:
    job = {"kind": "poincare", "scene": named("cam", "cam"), "record": 2}
    section = {"channel": "cam.theta", "value": 1.0}
    admit(job | {"section": section})
    section = {"channel": "cam.normal_force", "value": -1.0}
    with pytest.raises(InvalidInput, match="A normal force is never below zero"):
        admit(job | {"section": section})


def test_a_joint_and_a_driver_may_not_share_one() -> None:
    with pytest.raises(InvalidInput) as refused:
        admit({"kind": "simulate", "scene": named("cam", "motor"), "duration": 1.0})
    assert [one.pointer for one in refused.value.problems] == [
        "/scene/joints/motor",
        "/scene/drivers/motor",
    ]
