"""Channels of a scene over HTTP, and where its sections may be taken."""

import pytest

from jointplay.solver.kinds.assembled import resolved_scene
from jointplay.solver.scene.channels import channels


def asked(http, **document):
    return http.post("/v1/scenes/channels", json=document)


def test_channels_contacts_and_sections_of_a_driven_mechanism(http):
    scene = {"preset": "slider-crank", "parameters": {"clearance": 1e-4, "speed": 100.0}}
    found = asked(http, scene=scene).json()
    known = [(one.name, one.unit) for one in channels(resolved_scene(scene))]
    assert [(one["name"], one["unit"]) for one in found["channels"]] == known
    assert "P" in found["contacts"]
    assert found["sections"][:2] == [{"crank_angle": 0.0}, {"onset": "P"}]
    assert found["period"] == pytest.approx(0.06283185307)  # 2 pi / 100 rad/s


def test_a_scene_that_cannot_be_read_is_refused(http):
    refused = asked(http, scene={"preset": "slider-crank", "parameters": {"clearance": -1}})
    assert refused.status_code == 422
    assert refused.json()["errors"][0]["pointer"].endswith("/parameters/clearance")
