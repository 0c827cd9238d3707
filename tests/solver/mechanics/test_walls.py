"""A slider's corners at the walls of its guide: forces, work, momentum, symmetry."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from jointplay.solver.quantities.frames import cross
from jointplay.solver.scene.references import reference_problems
from tests.solver.moved_scenes import mirrored, turned
from tests.solver.random_mechanisms import near_start, numbers
from tests.solver.readable_mechanics import Instant, at_start, scene_of
from tests.solver.sliders import HEIGHT, LENGTH, block, hanging, rocker, swinging

MIRRORED = {1: 4, 2: 3, 3: 2, 4: 1}
"""Corners that a mirror along the guide's axis makes of each other."""
WITHOUT_RADII = {
    "lankarani-nikravesh": {"stiffness": 1e8},
    "adams-impact": {"stiffness": 1e8, "damping": 1e3, "full_damping_depth": 1e-4},
    "stiffness-and-dissipation": {
        "stiffness": {"law": "power", "stiffness": 1e8},
        "dissipation": {"law": "hunt-crossley", "restitution": 0.9},
    },
}
CORNERS = [f"guide.corner_{k}" for k in MIRRORED]
tilted = near_start(scene_of(swinging()), 2e-3)
slotted = near_start(scene_of(rocker(1e-3)), 2e-3)


def assert_close(found: object, expected: object) -> None:
    # rounding: forces of up to 1e4 N are differences of positions of 1 m in stiffnesses of 1e8
    np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-7)


def on_its_slot(instant: Instant) -> Instant:
    """Return a hanging bar with its pin on the slot's axis, and moving along it."""
    body, (x, y) = "bar", instant.scene.bodies["bar"].points["P"]
    q, v = dict(instant.position), dict(instant.speed)
    c, s = np.cos(q[f"{body}.theta"]), np.sin(q[f"{body}.theta"])
    arm = np.array([c * x - s * y, s * x + c * y])
    pin = np.array([q["bar.x"], q["bar.y"]]) + arm
    rate = [v["bar.x"] - v["bar.theta"] * arm[1], v["bar.y"] + v["bar.theta"] * arm[0]]
    q["bar.y"] += 0.2 * pin[0] - pin[1]
    v["bar.y"] += 0.2 * rate[0] - rate[1]
    return replace(instant, position=q, speed=v)


@settings(max_examples=25)
@given(near_start(scene_of(hanging()), 0.3).map(on_its_slot))
def test_an_ideal_slot_only_pushes_across_and_both_formulations_agree(instant: Instant) -> None:
    one, two = instant.reduced(), instant.lagrange()
    x, y = one.joint_force["slot"]
    assert x + 0.2 * y == pytest.approx(0.0, abs=1e-9 * abs(y))
    assert_close(one.bodies["bar"].acceleration, two.bodies["bar"].acceleration)
    assert_close(one.bodies["bar"].angular_acceleration, two.bodies["bar"].angular_acceleration)
    assert_close(one.joint_force["slot"], two.joint_force["slot"])
    body = instant.scene.bodies["bar"]
    assert_close(
        body.mass * np.array(one.bodies["bar"].acceleration),
        np.add((x, y), (0.0, -9.81 * body.mass)),
    )


@settings(max_examples=25)
@given(st.one_of(tilted, slotted))
def test_lagrange_agrees_with_reduced(instant: Instant) -> None:
    one, two = instant.reduced(), instant.lagrange()
    for name in instant.scene.bodies:
        assert_close(one.bodies[name].acceleration, two.bodies[name].acceleration)
        assert_close(one.bodies[name].angular_acceleration, two.bodies[name].angular_acceleration)
    for name, force in one.joint_force.items():
        assert_close(force, two.joint_force[name])
    assert_close(list(one.held_moment.values()), list(two.held_moment.values()))


@settings(max_examples=25)
@given(tilted)
def test_a_free_block_obeys_newton_and_euler_by_the_guides_force_and_moment(
    instant: Instant,
) -> None:
    found, body = instant.reduced(), instant.scene.bodies["block"]
    force = np.add(found.joint_force["guide"], (0.0, -9.81 * body.mass))
    assert_close(body.mass * np.array(found.bodies["block"].acceleration), force)
    angle = found.bodies["block"].angle
    c, s = np.cos(angle), np.sin(angle)
    x, y = body.points["S"]
    moment = found.held_moment["guide"] + cross(
        (c * x - s * y, s * x + c * y), found.joint_force["guide"]
    )
    assert_close(body.inertia * found.bodies["block"].angular_acceleration, moment)


@settings(max_examples=25)
@given(st.one_of(tilted, slotted))
def test_rates_of_penetration_are_those_of_neighbouring_poses(instant: Instant) -> None:
    step = 1e-6
    before, after = (
        replace(
            instant,
            position={n: q + sense * step * instant.speed[n] for n, q in instant.position.items()},
            driven={
                n: q + sense * step * instant.scene.drivers[n].speed
                for n, q in instant.driven.items()
            },
        )
        .reduced()
        .contacts
        for sense in (-1.0, 1.0)
    )
    for name, contact in instant.reduced().contacts.items():
        rate = (after[name].penetration - before[name].penetration) / (2.0 * step)
        # the difference leaves out step^2 of third derivatives, and rounds 1e-17 m / 1e-6 s
        assert contact.penetration_rate == pytest.approx(rate, abs=1e-7)


@settings(max_examples=25)
@given(tilted, numbers(-3.0, 3.0))
def test_nothing_depends_on_the_frame(instant: Instant, angle: float) -> None:
    here, there = instant.reduced().contacts, turned(instant, angle).reduced().contacts
    for name in CORNERS:
        assert_close(here[name].penetration, there[name].penetration)
        assert_close(here[name].normal_force, there[name].normal_force)
        assert_close(here[name].friction_force, there[name].friction_force)


@settings(max_examples=25)
@given(tilted)
def test_in_a_mirror_corners_change_sides(instant: Instant) -> None:
    def swapped(values: dict[str, float]) -> dict[str, float]:
        return {f"guide.corner_{k}": values[f"guide.corner_{m}"] for k, m in MIRRORED.items()}

    here = instant.reduced().contacts
    changes = {"mode": swapped(instant.mode), "impact_rate": swapped(instant.impact_rate)}
    there = replace(mirrored(instant), **changes).reduced().contacts
    for k, m in MIRRORED.items():
        one, two = here[f"guide.corner_{k}"], there[f"guide.corner_{m}"]
        assert_close(one.penetration, two.penetration)
        assert_close(one.friction_force, -two.friction_force)


@settings(max_examples=25)
@given(st.sampled_from(CORNERS), numbers(-0.01, 0.01), numbers(-1e-3, 1e-3))
def test_gaps_are_those_of_the_drawing(corner: str, tilt: float, aside: float) -> None:
    instant = at_start(scene_of(block()))
    position = {"block.x": 3.0, "block.y": aside, "block.theta": tilt}
    found = replace(instant, position=position).reduced().contacts[corner]
    along, side = {"1": (1, 1), "2": (-1, 1), "3": (-1, -1), "4": (1, -1)}[corner[-1]]
    height = aside + along * LENGTH / 2 * np.sin(tilt) + side * HEIGHT / 2 * np.cos(tilt)
    assert found.penetration == pytest.approx(side * height - HEIGHT / 2 - 1e-3, abs=1e-15)


@settings(max_examples=25)
@given(slotted)
def test_a_pin_pushes_across_the_slot_and_rubs_at_its_own_radius(instant: Instant) -> None:
    found = instant.reduced()
    angle = found.bodies["rocker"].angle
    n, t = np.array([-np.sin(angle), np.cos(angle)]), np.array([-np.cos(angle), -np.sin(angle)])
    force = np.zeros(2)
    for name, side in (("slot.wall_1", 1.0), ("slot.wall_2", -1.0)):
        contact = found.contacts[name]
        force += side * (-contact.normal_force * n + contact.friction_force * t)
        assert contact.interaction.moment_on_second == pytest.approx(
            0.01 * contact.friction_force, rel=1e-9, abs=1e-12
        )
    assert_close(found.joint_force["slot"], force)


@pytest.mark.parametrize("law", WITHOUT_RADII)
def test_laws_whose_stiffness_is_given_press_corners_apart(law: str) -> None:
    instant = at_start(scene_of(block(contact={"law": law, **WITHOUT_RADII[law]})))
    position = {"block.x": 0.0, "block.y": 1.1e-3, "block.theta": 0.0}
    touching = replace(instant, position=position, mode=dict.fromkeys(instant.mode, 1.0))
    found = touching.reduced().contacts
    # K d^1.5 at a depth of 0.1 mm, at rest: nothing is damped
    assert found["guide.corner_1"].normal_force == pytest.approx(1e8 * 1e-4**1.5, rel=1e-9)
    assert found["guide.corner_3"].normal_force == 0.0


@pytest.mark.parametrize("stiffness", ["johnson", "hertz-spheres"])
def test_laws_of_radii_are_refused_at_walls(stiffness: str) -> None:
    parts = {
        "stiffness": {"law": stiffness},
        "dissipation": {"law": "hunt-crossley", "restitution": 0.9},
    }
    scene = scene_of(block(contact={"law": "stiffness-and-dissipation", **parts}))
    found = {problem.pointer: problem.detail for problem in reference_problems(scene)}
    assert "give a stiffness" in found["/joints/guide/clearance/contact"]
