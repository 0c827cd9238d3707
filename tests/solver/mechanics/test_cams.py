"""Cams at single instants: closed forms, both formulations, rates, work, mirror."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from jointplay.records.failure import InvalidInput
from jointplay.solver.kinds import admit
from jointplay.solver.kinds.assembled import assembled_scene
from jointplay.solver.quantities.frames import cross
from tests.solver.cams import CIRCLE, ECCENTRICITY, RADIUS, follower, pitch_table, rocker, valve
from tests.solver.mechanics.test_mechanics import assert_formulations_agree
from tests.solver.moved_scenes import flip
from tests.solver.random_mechanisms import near_start
from tests.solver.readable_mechanics import Instant, at_start, scene_of

RUBS = {"friction": {"coefficient": 0.2}}
PROFILES: dict[str, dict[str, Any]] = {"flat": CIRCLE, "roller": pitch_table(24)}


def touching(shape: str) -> st.SearchStrategy[Instant]:
    joint = follower(shape, PROFILES[shape], lash=1e-4, **RUBS)
    return near_start(scene_of(rocker(joint)), 2e-3)


shapes = pytest.mark.parametrize("shape", list(PROFILES))


@shapes
@settings(max_examples=10)
@given(data=st.data())
def test_rates_are_those_of_neighbouring_poses_and_the_work_is_that_of_depth_and_slip(
    shape: str, data: st.DataObject
) -> None:
    instant = data.draw(touching(shape))
    step = 1e-7

    def moved(sense: float) -> Instant:
        position = {n: q + sense * step * instant.speed[n] for n, q in instant.position.items()}
        return replace(instant, position=position)

    found, bodies = instant.reduced().contacts["cam"], instant.reduced().bodies
    before, after = (moved(sense).reduced().contacts["cam"] for sense in (-1.0, 1.0))
    rate = (after.penetration - before.penetration) / (2.0 * step)
    assert found.penetration_rate == pytest.approx(rate, rel=1e-7, abs=1e-8)
    push = found.interaction
    put_in = 0.0
    for reference, sense, moment in (
        (push.first, -1.0, push.moment_on_first),
        (push.second, 1.0, push.moment_on_second),
    ):
        name, point = reference.split(".")
        body, (x, y) = bodies[name], instant.scene.bodies[name].points[point]
        c, s = np.cos(body.angle), np.sin(body.angle)
        arm = np.array([c * x - s * y, s * x + c * y])
        velocity = np.array(body.velocity) + body.spin * np.array([-arm[1], arm[0]])
        put_in -= sense * float(velocity @ push.force_on_second) + moment * body.spin
    expected = found.contact_power + found.friction_loss
    assert put_in == pytest.approx(expected, rel=1e-9, abs=1e-9)


@shapes
@settings(max_examples=10)
@given(data=st.data())
def test_both_formulations_agree_and_a_mirror_changes_sides(
    shape: str, data: st.DataObject
) -> None:
    instant = data.draw(touching(shape))
    assert_formulations_agree(instant)
    document = instant.scene.model_dump()
    document["gravity"] = flip(instant.scene.gravity)
    for owner in (document["ground"], *document["bodies"].values()):
        owner["points"] = {name: flip(position) for name, position in owner["points"].items()}
    joint = document["joints"]["cam"]
    if shape == "flat":  # of the opposite angle: -sin becomes sin
        joint["normal"] = flip(joint["normal"])
        joint["profile"]["amplitude"] *= -1.0
    else:
        joint["profile"]["values"] = joint["profile"]["values"][::-1]
    there = replace(
        instant,
        scene=scene_of(document),
        position={name: -q for name, q in instant.position.items()},
        speed={name: -v for name, v in instant.speed.items()},
    )
    one, two = instant.reduced().contacts["cam"], there.reduced().contacts["cam"]
    assert two.penetration == pytest.approx(one.penetration, rel=1e-9, abs=1e-15)
    assert two.normal_force == pytest.approx(one.normal_force, rel=1e-6)
    assert two.slip_velocity == pytest.approx(-one.slip_velocity, rel=1e-9, abs=1e-12)
    assert two.friction_force == pytest.approx(-one.friction_force, rel=1e-6)


@shapes
@pytest.mark.parametrize("build", [valve, rocker])
def test_ideal_cams_hold_their_followers_alike_in_both_formulations(shape: str, build: Any) -> None:
    joint = follower(shape, PROFILES[shape])
    scene = valve(joint, driven=False) if build is valve else rocker(joint)
    start = at_start(scene_of(scene))
    assert_formulations_agree(start)
    pushed = start.reduced().joint_force["cam"]
    # without friction the force is along the common normal; a lever's arm about the cam's centre
    lever = cross((0.0, -ECCENTRICITY), pushed)  # the circle's centre, beside the shaft's
    assert abs(pushed[1]) > 1.0
    if build is valve and shape == "flat":
        assert pushed[0] == pytest.approx(0.0, abs=1e-9)
        assert lever == pytest.approx(0.0, abs=1e-9)


@settings(max_examples=20)
@given(st.floats(-3.0, 3.0), st.floats(0.01, 0.06))
def test_a_face_is_as_far_from_an_eccentric_circle_as_the_drawing_says(
    angle: float, height: float
) -> None:
    joint = follower("flat", CIRCLE, lash=1e-4)
    start = at_start(scene_of(valve(joint)))
    position = {"tappet.s": height - 0.05}
    found = replace(start, position=position, driven={"motor": angle}).reduced().contacts["cam"]
    # the circle's centre is e below the shaft's at angle 0
    top = RADIUS - ECCENTRICITY * np.cos(angle)
    assert found.penetration == pytest.approx(top - height - 1e-4, abs=1e-15)


def test_knots_that_end_a_turn_to_seven_digits_end_it_and_no_others_do() -> None:
    profile = pitch_table(24)
    profile["knots"][-1] = 6.2831853
    joint = follower("roller", profile)
    admitted = admit({"kind": "simulate", "scene": valve(joint), "duration": 0.1})
    assert admitted.scene.joints["cam"].profile.period == 2.0 * np.pi
    assert admitted.job["scene"]["joints"]["cam"]["profile"]["knots"][-1] == 2.0 * np.pi
    lobes = profile | {"knots": [0.0, 1.0, 2.0, 3.1415927], "values": [0.04, 0.042, 0.041, 0.04]}
    half = scene_of(valve(follower("roller", lobes))).joints["cam"].profile
    assert half.period == np.pi
    profile["knots"][-1] = 6.28320
    with pytest.raises(InvalidInput, match="this one repeats after"):
        admit({"kind": "simulate", "scene": valve(joint), "duration": 0.1})


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_roller_begins_on_the_side_of_its_cam_where_the_point_of_its_guide_is(
    side: float,
) -> None:
    scene = valve(follower("roller", pitch_table()))
    scene["ground"]["points"]["G"] = [0.0, 0.05 * side]
    del scene["start"]
    _, y, _ = assembled_scene(scene, is_whole=True).pose()["tappet"]
    assert (y - 0.02) * side > ECCENTRICITY


def test_a_roller_that_begins_at_the_centre_of_its_cam_needs_a_position() -> None:
    scene = valve(follower("roller", pitch_table()))
    scene["joints"]["guide"]["guide"] = "ground.O"
    job = {"kind": "simulate", "scene": scene, "duration": 0.1}
    assert admit(job)
    del scene["start"]
    with pytest.raises(InvalidInput) as refused:
        admit(job)
    (problem,) = refused.value.problems
    assert problem.pointer == "/scene/start/points"
    assert "'tappet.F' of joint 'cam' begins where 'shaft.O' is" in problem.detail
