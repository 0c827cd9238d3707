"""Hints of a check at what is allowed and may be meant otherwise."""

from typing import Any

import pytest

from jointplay.solver.kinds.assembled import assembled_scene
from jointplay.solver.scene import presets
from tests.solver.sliders import block, swinging


def pulled(**spring: Any) -> dict[str, Any]:
    """A block on an ideal slide, pulled from (0.3, 0.4) m."""
    scene = block()
    del scene["joints"]["guide"]["clearance"]
    scene["ground"]["points"]["W"] = [0.3, 0.4]
    element = {
        "type": "spring-damper",
        "first": "ground.W",
        "second": "block.S",
        "stiffness": 100.0,
    }
    return scene | {"forces": {"spring": element | spring}}


TORQUE: dict[str, Any] = {"type": "torque", "moment": 2.0}


def turned(scene: dict[str, Any], first: str, element: dict[str, Any] = TORQUE) -> dict[str, Any]:
    """The block of a scene under a moment against a point."""
    return scene | {"forces": {"push": {"first": first, "second": "block.S"} | element}}


def hints(scene: dict[str, Any]) -> list[tuple[str, str]]:
    return list(assembled_scene(scene, is_whole=True).hints)


def test_a_spring_without_a_free_length_is_told_with_the_one_that_is_drawn():
    ((pointer, detail),) = hints(pulled())
    assert pointer == "/forces/spring/free_length"
    assert "it is 0.5 m long and pulls with 50 N" in detail
    assert '"free_length": 0.5' in detail


def test_it_is_told_of_a_scene_that_cannot_be_run():
    scene = pulled()
    scene["bodies"]["adrift"] = {"mass": 1.0, "inertia": 1.0}
    found = assembled_scene(scene, is_whole=True)
    assert found.refusal is not None
    assert [one.pointer for one in found.hints] == ["/forces/spring/free_length"]


def test_a_free_length_that_is_given_is_meant():
    scene = pulled()
    target = {"path": "/forces/spring/free_length"}
    scene["parameters"] = {"length": {"help": "Free length.", "targets": [target]}}
    assert hints(scene) == []
    assert hints(pulled(free_length=0.0)) == []
    assert hints(pulled(stiffness=0.0, damping=1.0)) == []


ELEMENTS = {
    "a torque": TORQUE,
    "a spring": {"type": "torsion-spring", "stiffness": 1.0},
    "a motor": {"type": "motor", "stall_torque": 1.0, "no_load_speed": 10.0},
}


@pytest.mark.parametrize("element", ELEMENTS.values(), ids=ELEMENTS)
def test_a_moment_on_what_cannot_turn_is_told(element):
    scene = block()
    del scene["joints"]["guide"]["clearance"]
    ((pointer, detail),) = hints(turned(scene, "ground.O", element))
    assert pointer == "/forces/push"
    assert "'block' does not turn against 'ground', as 'guide' holds its angle" in detail


def test_a_moment_on_what_turns_or_may_tilt_is_not():
    assert hints(turned(block(), "ground.O")) == []
    aslant = swinging()
    assert hints(turned(aslant, "ground.O")) == []
    del aslant["joints"]["guide"]["clearance"]
    assert hints(turned(aslant, "ground.O")) == []  # the link turns, and the block with it
    ((_, detail),) = hints(turned(aslant, "link.G"))
    assert "against 'link', as 'guide'" in detail


def test_a_journal_that_starts_deep_in_its_bearing_is_told():
    scene = presets.document("bouncing-journal")
    (name, joint), *_ = scene["joints"].items()
    play = joint["clearance"]["radial_clearance"]
    del scene["parameters"]
    for factor, told in ((1.001, []), (2.5, [f"/start/joints/{name}/eccentricity"])):
        scene["start"] = {"joints": {name: {"eccentricity": [0.0, -factor * play]}}}
        assert [pointer for pointer, _ in hints(scene)] == told


def test_of_a_preset_nothing_is_told():
    assert assembled_scene({"preset": "impact-oscillator"}, is_whole=False).hints == []
