"""Mechanisms that a client moves before they are run."""

import math

import numpy as np
import pytest

from jointplay.client import Refused
from tests.two_assemblies import arm


def test_a_mechanism_is_followed_through_a_turn_of_its_drivers(client):
    first = client.poses("four-bar")
    assert (first["times"], first["stopped"]) == ([0.0], None)
    times = np.linspace(0.0, first["drivers_time"], 5)
    found = client.poses("four-bar", times=times)
    assert found["times"] == times.tolist()
    assert found["poses"][0] == first["poses"][0]
    start, *_, end = (pose["crank"][2] for pose in found["poses"])
    assert abs(end - start) == pytest.approx(2.0 * math.pi)


def test_parameters_are_set_and_documents_taken(client):
    slow, fast = (client.poses("four-bar", speed=speed)["drivers_time"] for speed in (10.0, 20.0))
    assert slow == pytest.approx(2.0 * fast)
    found = client.poses(arm(position=0.2, speed=1.0), times=(0.0, 0.5))
    assert [pose["arm"][2] for pose in found["poses"]] == pytest.approx([0.2, 0.7])


def test_a_point_is_dragged_from_pose_to_pose(client):
    pose = client.drag("four-bar", "crank.B", (0.1, 0.3))
    assert pose["crank"][2] == pytest.approx(math.atan2(0.3, 0.1), abs=1e-2)
    pose = client.drag("four-bar", "crank.B", np.array([-0.3, 0.1]), pose=pose)
    assert pose["crank"][2] == pytest.approx(math.atan2(0.1, -0.3), abs=1e-2)


def test_what_cannot_be_moved_is_refused_at_its_field(client):
    with pytest.raises(Refused) as refused:
        client.drag("four-bar", "crank.Z", (0.0, 0.0))
    assert [one.pointer for one in refused.value.fields] == ["/point"]
    with pytest.raises(Refused) as refused:
        client.poses("four-bar", times=(1.0, 0.5))
    assert [one.pointer for one in refused.value.fields] == ["/times/1"]
