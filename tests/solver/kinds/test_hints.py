"""Hints of a check at what is allowed and may be meant otherwise."""

import math
from typing import Any

import pytest

from jointplay.solver.kinds.assembled import assembled_scene
from jointplay.solver.kinds.declared_hints import other_units
from jointplay.solver.scene import presets
from jointplay.solver.scene.document import Scene
from tests.solver.cams import CIRCLE, ECCENTRICITY, RADIUS, follower, valve
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
    scene["parameters"] = {"length": {"help": "Free length.", "unit": "m", "targets": [target]}}
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


LINE = {
    "law": "stiffness-and-dissipation",
    "stiffness": {"law": "johnson", "youngs_modulus": 2e11, "poisson_ratio": 0.3},
    "dissipation": {"law": "none"},
}


def test_a_width_that_no_law_uses_is_told():
    scene = presets.document("bouncing-journal")
    (name, joint), *_ = scene["joints"].items()
    del scene["parameters"]
    pointer = f"/joints/{name}/clearance"
    assert hints(scene) == []
    joint["clearance"]["bearing_width"] = 0.01
    ((told, detail),) = hints(scene)
    assert told == f"{pointer}/bearing_width"
    assert detail.startswith("No law of this clearance uses the bearing_width")
    joint["clearance"]["contact"] = LINE
    assert hints(scene) == []


def test_a_width_is_not_told_where_a_parameter_chooses_the_law():
    scene = presets.document("bouncing-journal")
    (name, joint), *_ = scene["joints"].items()
    stiffness = {"law": "hertz-spheres", "youngs_modulus": 2e11, "poisson_ratio": 0.3}
    joint["clearance"] |= {"bearing_width": 0.01, "contact": LINE | {"stiffness": stiffness}}
    path = f"/joints/{name}/clearance/contact/stiffness/law"
    law = {"help": "The law.", "choices": ["hertz-spheres", "johnson"], "targets": [{"path": path}]}
    scene["parameters"] = {"law": law}
    assert hints(scene) == []


UNITS = {
    "another": ("N", 1.0, True),
    "left out": (None, 1.0, True),
    "its own": ("N/m", 1.0, False),
    "its own, written otherwise": ("kg/s^2", -1.0, False),
    "converted": ("mm", 1e3, False),
}


@pytest.mark.parametrize(("unit", "factor", "is_told"), UNITS.values(), ids=UNITS)
def test_a_unit_that_is_not_that_of_the_target_is_told(unit, factor, is_told):
    scene = pulled(free_length=0.1)
    target = {"path": "/forces/spring/stiffness", "factor": factor}
    parameter = {"help": "Stiffness of the spring.", "targets": [target]}
    scene["parameters"] = {"k": parameter | ({} if unit is None else {"unit": unit})}
    found = hints(scene)
    assert [pointer for pointer, _ in found] == ["/parameters/k/unit"] * is_told
    assert all("counts in N/m" in detail and '"unit": "N/m"' in detail for _, detail in found)


def test_units_of_coordinates_and_starts_are_known():
    scene = pulled(free_length=0.1)
    paths = {
        "/ground/points/W/1": "m",
        "/gravity/1": "m/s^2",
        "/start/angular_velocities/block": "rad/s",
        "/bodies/block/inertia": "kg m^2",
    }
    scene["gravity"] = [0.0, -9.81]
    scene["parameters"] = {
        f"p{at}": {"help": "A number.", "unit": "Pa", "targets": [{"path": path}]}
        for at, path in enumerate(paths)
    }
    found = hints(scene)
    assert [pointer for pointer, _ in found] == [f"/parameters/p{at}/unit" for at in range(4)]
    for (_, detail), unit in zip(found, paths.values(), strict=True):
        assert f"counts in {unit}," in detail


def test_units_of_presets_are_those_of_their_targets():
    for name in presets.names():
        assert list(other_units(Scene.model_validate(presets.document(name)))) == []


def crank(**more: Any) -> dict[str, Any]:
    """A crank on a pin of the ground."""
    points = {"O": [-0.05, 0.0], "A": [0.05, 0.0]}
    return {
        "name": "crank",
        "ground": {"points": {"O": [0.0, 0.0]}},
        "bodies": {"crank": {"mass": 0.5, "inertia": 4e-4, "points": points}},
        "joints": {"main": {"type": "revolute", "bearing": "ground.O", "journal": "crank.O"}},
    } | more


def test_an_angle_of_more_than_a_turn_is_told_as_degrees():
    assert hints(crank(start={"angles": {"crank": -6.283}})) == []
    ((pointer, detail),) = hints(crank(start={"angles": {"crank": 45.0}}))
    assert pointer == "/start/angles/crank"
    assert detail == "45 rad are 7.16 turns. If degrees are meant, give 0.785398163."
    driven = crank(drivers={"motor": {"joint": "main", "position": 90.0, "speed": 1.0}})
    assert [pointer for pointer, _ in hints(driven)] == ["/drivers/motor/position"]
    slid = pulled(free_length=0.1)
    slid["drivers"] = {"push": {"joint": "guide", "position": 90.0, "speed": 1.0}}
    assert hints(slid) == []  # 90 m


def test_an_inertia_in_square_millimetres_is_told():
    scene = crank()
    scene["bodies"]["crank"]["inertia"] = 400.0
    ((pointer, detail),) = hints(scene)
    assert pointer == "/bodies/crank/inertia"
    assert "a radius of gyration of 28.3 m" in detail  # the root of 400 / 0.5
    assert detail.endswith("If kg mm^2 are meant, give 0.0004.")


def test_a_torsion_spring_without_a_free_angle_is_told_with_the_one_that_is_drawn():
    ends = {"first": "ground.O", "second": "crank.O"}
    spring: dict[str, Any] = {"type": "torsion-spring", "stiffness": 5.0} | ends
    start = {"angles": {"crank": 0.3}}
    ((pointer, detail),) = hints(crank(forces={"spring": spring}, start=start))
    assert pointer == "/forces/spring/free_angle"
    assert "it is twisted by 0.3 rad and turns 'crank' with -1.5 N m" in detail
    assert '"free_angle": 0.3' in detail
    assert hints(crank(forces={"spring": spring})) == []
    assert hints(crank(forces={"spring": spring | {"free_angle": 0.0}}, start=start)) == []


def test_a_driver_of_the_ground_against_a_body_is_told():
    exchanged = {"type": "revolute", "bearing": "crank.O", "journal": "ground.O"}
    scene = crank(drivers={"motor": {"joint": "main", "speed": 1.0}})
    assert hints(scene) == []
    scene["joints"]["main"] = exchanged
    ((pointer, detail),) = hints(scene)
    assert pointer == "/drivers/motor/joint"
    assert "so 'crank' turns clockwise as the position of 'motor' grows" in detail
    velocity = assembled_scene(scene, is_whole=True).assembly.velocity
    assert velocity[2] == -1.0  # rad/s


def test_a_driver_that_starts_elsewhere_than_its_body_is_told_with_the_position_to_give():
    start = {"angles": {"crank": 0.3}}
    motor: dict[str, Any] = {"joint": "main", "speed": 1.0}
    ((pointer, detail),) = hints(crank(drivers={"motor": motor}, start=start))
    assert pointer == "/drivers/motor/position"
    assert "starts at 0 rad, where 'start.angles' says 0.3" in detail
    assert '"position": 0.3' in detail
    assert hints(crank(drivers={"motor": motor | {"position": 0.3}}, start=start)) == []
    wave = {"type": "sinusoidal", "amplitude": 0.2, "frequency": 1.0, "offset": 0.1}
    swung = {"body": "crank", "motion": wave}
    ((_, detail),) = hints(crank(drivers={"motor": swung}, start=start))
    assert '"position": 0.2' in detail
    scene = crank(drivers={"motor": swung | {"position": 0.2}}, start=start)
    assert not assembled_scene(scene, is_whole=True).assembly.misfits


@pytest.mark.parametrize(("normal", "is_told"), [([0.0, 1.0], False), ([0.0, -2.0], True)])
def test_a_face_that_starts_beyond_its_cam_is_told(normal, is_told):
    scene = valve(follower("flat", CIRCLE) | {"normal": normal})
    del scene["start"]
    found = hints(scene)
    assert [pointer for pointer, _ in found] == ["/joints/cam/normal"] * is_told
    assert all("If it shall start there, give [0, 2]" in detail for _, detail in found)
    height = assembled_scene(scene, is_whole=True).pose()["tappet"][1] - 0.02  # of the face
    # the circle's centre is below that of the shaft
    assert height == pytest.approx(-RADIUS - ECCENTRICITY if is_told else RADIUS - ECCENTRICITY)


def test_a_modulus_in_gigapascals_is_told():
    scene = presets.document("bouncing-journal")
    (name, joint), *_ = scene["joints"].items()
    del scene["parameters"]
    joint["clearance"] |= {"bearing_width": 0.01, "contact": LINE}
    assert hints(scene) == []
    stiffness = LINE["stiffness"] | {"youngs_modulus": 207.0}
    joint["clearance"]["contact"] = LINE | {"stiffness": stiffness}
    ((pointer, detail),) = hints(scene)
    assert pointer == f"/joints/{name}/clearance/contact/stiffness/youngs_modulus"
    assert detail.endswith("If GPa are meant, give 2.07e+11.")


@pytest.mark.parametrize(("last", "is_told"), [(6.28, True), (6.2831853, False), (3.0, False)])
def test_a_course_that_repeats_after_nearly_a_turn_is_told(last, is_told):
    course = {"type": "table", "knots": [0.0, 1.0, last], "values": [0.0, 1.0, 0.0]}
    load: dict[str, Any] = {
        "type": "torque",
        "first": "ground.O",
        "second": "crank.O",
        "moment": 1.0,
        "over": {"quantity": "angle"},
        "course": course | {"outside": "periodic"},
    }
    found = hints(crank(forces={"load": load}))
    assert [pointer for pointer, _ in found] == ["/forces/load/course"] * is_told
    assert all("repeats after 6.28 rad, and so shifts by -0.0032 rad" in text for _, text in found)


@pytest.mark.parametrize(("angle", "is_told"), [(0.3, False), (0.001234, True)])
def test_a_body_that_starts_fast_beside_a_dead_point_is_told(angle, is_told):
    scene = presets.document("slider-crank")
    for name in ("parameters", "outputs", "drivers", "reported"):
        scene.pop(name, None)
    for joint in scene["joints"].values():
        joint.pop("clearance", None)
    crank, rod = 0.05, 0.12  # m
    tilt = -round(math.asin(crank / rod * math.sin(angle)), 6)  # as it is typed
    found = hints(
        scene
        | {"start": {"angles": {"crank": angle, "rod": tilt}, "velocities": {"slider": [1, 0]}}}
    )
    assert [pointer for pointer, _ in found] == ["/start/velocities/slider"] * is_told
    reach = math.sqrt(rod**2 - (crank * math.sin(angle)) ** 2)
    stroke = -crank * math.sin(angle) * (1.0 + crank * math.cos(angle) / reach)  # m/rad
    assert all(f"'crank' starts at {crank / 2 / abs(stroke):.4g} m/s" in text for _, text in found)
    assert all(f" and {1 / stroke:.4g} rad/s" in text for _, text in found)


def test_of_a_preset_nothing_is_told():
    assert assembled_scene({"preset": "impact-oscillator"}, is_whole=False).hints == []
