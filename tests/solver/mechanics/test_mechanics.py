"""Laws of nature that the equations of motion keep at any instant, in both formulations."""

import math
from collections.abc import Iterator

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from jointplay.solver.mechanics.motion import Motion
from jointplay.solver.scene.document import Scene
from tests.solver.random_mechanisms import closed, instants, near_start, trees
from tests.solver.readable_mechanics import Instant, at_start, preset

ROUNDING = 1e-9
"""Relative to the largest term. Masses, inertias and lever arms of the drawn mechanisms differ by
at most 1e3 and five bodies in a chain multiply condition numbers to about 1e6 times 2e-16."""

anywhere = st.one_of(instants(trees()), closed())
presets_near_start = st.one_of(
    near_start(preset("seven-bar-press", friction=0.1), 1e-3),
    near_start(preset("slider-crank"), 1e-3),
    near_start(preset("bouncing-journal"), 2e-3),
    near_start(preset("pendulum"), 1.0),
)


def numbers_of(motion: Motion) -> dict[str, np.ndarray]:
    found = {}
    for name, body in motion.bodies.items():
        found[f"{name} pose"] = np.array([*body.position, body.angle])
        found[f"{name} velocity"] = np.array([*body.velocity, body.spin])
        found[f"{name} acceleration"] = np.array([*body.acceleration, body.angular_acceleration])
    for name, force in motion.joint_force.items():
        found[f"{name} force"] = np.array(force)
    for name, moment in motion.held_moment.items():
        found[f"{name} moment"] = np.array([moment])
    for name, effort in motion.driver_effort.items():
        found[f"{name} effort"] = np.array([effort])
    for name, contact in motion.contacts.items():
        found[f"{name} contact"] = np.array(
            [contact.penetration, contact.penetration_rate, contact.normal_force]
        )
    return found


def largest(motion: Motion, *kinds: str) -> float:
    found = numbers_of(motion)
    return max([1.0, *(float(np.abs(v).max()) for k, v in found.items() if k.split()[1] in kinds)])


def assert_formulations_agree(instant: Instant) -> None:
    reduced, lagrange = instant.reduced(), instant.lagrange()
    one, two = numbers_of(reduced), numbers_of(lagrange)
    assert one.keys() == two.keys()
    for name, value in one.items():
        # forces and accelerations mix through masses and inertias of 0.01 to 4
        scale = 100.0 * largest(reduced, "acceleration", "force", "effort", "velocity")
        np.testing.assert_allclose(value, two[name], rtol=0, atol=ROUNDING * scale, err_msg=name)


@given(anywhere)
def test_joint_coordinates_and_multipliers_give_the_same_motion_and_forces(
    instant: Instant,
) -> None:
    assert_formulations_agree(instant)


@given(presets_near_start)
def test_both_formulations_agree_on_every_preset(instant: Instant) -> None:
    assert_formulations_agree(instant)


def point_of(instant: Instant, motion: Motion, reference: str) -> tuple[str, np.ndarray]:
    body, point = reference.split(".")
    if body == "ground":
        return body, np.array(instant.scene.ground.points[point])
    x, y = instant.scene.bodies[body].points[point]
    angle = motion.bodies[body].angle
    c, s = math.cos(angle), math.sin(angle)
    return body, np.array(motion.bodies[body].position) + np.array([c * x - s * y, s * x + c * y])


def contact_points(
    instant: Instant, motion: Motion, name: str
) -> tuple[tuple[str, np.ndarray], tuple[str, np.ndarray]]:
    """Return where the forces act, r_i + R_i n and r_j + R_j n, and on which bodies."""
    joint = instant.scene.joints[name]
    (bearing, r_i), (journal, r_j) = (
        point_of(instant, motion, reference) for _, reference in joint.ends
    )
    n = np.array(motion.contacts[name].normal)
    radius = joint.clearance.bearing_radius  # type: ignore[union-attr]
    clearance = joint.clearance.radial_clearance  # type: ignore[union-attr]
    return (bearing, r_i + radius * n), (journal, r_j + (radius - clearance) * n)


def velocity_of(motion: Motion, body: str, position: np.ndarray) -> np.ndarray:
    if body == "ground":
        return np.zeros(2)
    moving = motion.bodies[body]
    arm = position - moving.position
    return np.array(moving.velocity) + moving.spin * np.array([-arm[1], arm[0]])


@given(st.one_of(anywhere, presets_near_start))
def test_kinetic_energy_grows_by_the_powers_of_drivers_gravity_and_contacts(
    instant: Instant,
) -> None:
    motion = instant.reduced()
    gravity = np.array(instant.scene.gravity)
    growth, terms = 0.0, [1.0]
    for name, moving in motion.bodies.items():
        body = instant.scene.bodies[name]
        rates = [
            body.mass * np.dot(moving.acceleration, moving.velocity),
            body.inertia * moving.angular_acceleration * moving.spin,
            -body.mass * np.dot(gravity, moving.velocity),
        ]
        growth += sum(rates)
        terms += rates
    for name, effort in motion.driver_effort.items():
        growth -= effort * motion.driver_speed[name]
        terms.append(effort * motion.driver_speed[name])
    for name in motion.contacts:
        force = np.array(motion.joint_force[name])
        (bearing, at_bearing), (journal, at_journal) = contact_points(instant, motion, name)
        powers = [
            np.dot(force, velocity_of(motion, journal, at_journal)),
            -np.dot(force, velocity_of(motion, bearing, at_bearing)),
        ]
        growth -= sum(powers)
        terms += powers
    assert abs(growth) <= ROUNDING * max(abs(t) for t in terms)


@given(st.one_of(anywhere, presets_near_start))
def test_what_goes_into_contacts_is_the_work_of_their_forces(instant: Instant) -> None:
    motion = instant.reduced()
    for name, contact in motion.contacts.items():
        force = np.array(motion.joint_force[name])
        (bearing, at_bearing), (journal, at_journal) = contact_points(instant, motion, name)
        slip = velocity_of(motion, journal, at_journal) - velocity_of(motion, bearing, at_bearing)
        power = np.dot(force, slip)
        scale = max(1.0, np.abs(force).max() * np.abs(slip).max(), abs(contact.contact_power))
        balance = power + contact.contact_power + contact.friction_loss
        assert abs(balance) <= ROUNDING * scale
        assert contact.normal_force >= 0.0
        if instant.mode[name] == 0.0:
            assert contact.interaction.force_on_second == (0.0, 0.0)


def turning_efforts(scene: Scene, motion: Motion) -> Iterator[tuple[str, float]]:
    """Yield bodies that drivers turn, and the moments on them, N m."""
    for name, effort in motion.driver_effort.items():
        driver = scene.drivers[name]
        if driver.body is not None:
            yield driver.body, effort
            continue
        joint = scene.joints[driver.joint]
        for sense, (_, reference) in zip((-1.0, 1.0), joint.ends, strict=True):
            body = reference.split(".")[0]
            if body != "ground" and joint.type == "revolute":
                yield body, sense * effort


@given(st.one_of(anywhere, presets_near_start))
def test_every_body_obeys_newton_and_euler_under_its_joint_forces(instant: Instant) -> None:
    motion = instant.reduced()
    scene = instant.scene
    gravity = np.array(scene.gravity)
    force = {
        name: body.mass * (gravity - motion.bodies[name].acceleration)
        for name, body in scene.bodies.items()
    }
    moment = {
        name: -body.inertia * motion.bodies[name].angular_acceleration
        for name, body in scene.bodies.items()
    }
    unknown_moment = set()
    scale = largest(motion, "acceleration", "force", "effort")
    for name, joint in scene.joints.items():
        on_second = np.array(motion.joint_force[name])
        positions = (
            contact_points(instant, motion, name)
            if joint.has_play
            else [point_of(instant, motion, reference) for _, reference in joint.ends]
        )
        for sense, (body, position) in zip((-1.0, 1.0), positions, strict=True):
            if body == "ground":
                continue
            force[body] = force[body] + sense * on_second
            arm = position - motion.bodies[body].position
            moment[body] += sense * (arm[0] * on_second[1] - arm[1] * on_second[0])
            if joint.type != "revolute":
                unknown_moment.add(body)  # a guide or weld also carries a moment, not a channel
    for body, effort in turning_efforts(scene, motion):
        moment[body] += effort
    for name in scene.bodies:
        np.testing.assert_allclose(force[name], 0.0, atol=10 * ROUNDING * scale, err_msg=name)
        if name not in unknown_moment:
            assert abs(moment[name]) <= 10 * ROUNDING * scale, name


@pytest.mark.parametrize("formulation", ["reduced", "lagrange"])
def test_a_concentric_journal_divides_by_nothing(formulation: str) -> None:
    instant = at_start(preset("bouncing-journal"))
    assert instant.position["journal.x"] == instant.position["journal.y"] == 0.0
    instant.speed["journal.x"] = 0.3
    for mode in (0.0, 1.0):
        instant.mode["bearing"] = mode
        motion = instant.reduced() if formulation == "reduced" else instant.lagrange()
        contact = motion.contacts["bearing"]
        assert contact.normal_force == contact.friction_force == 0.0
        assert contact.penetration == -1e-3
        assert motion.bodies["journal"].acceleration == (0.0, -9.81)
