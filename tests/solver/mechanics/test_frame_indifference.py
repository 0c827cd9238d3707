"""Nothing depends on where the frame stands, how it is turned, or what is listed first."""

import json
import math
import random

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from jointplay.solver.mechanics.assembly import assemble
from jointplay.solver.mechanics.motion import Motion
from jointplay.solver.scene import presets
from jointplay.solver.scene.clocks import turns
from jointplay.solver.scene.document import Scene
from tests.solver.moved_scenes import flip, mirrored, reordered, translated, turn, turned
from tests.solver.random_mechanisms import instants, near_start, numbers, trees
from tests.solver.readable_mechanics import Instant, at_start, preset

CLOSE = 1e-9
"""Part of the largest value of its kind: positions move by up to 10 m, so lose two digits, and
chains of five bodies multiply rounding by their condition, at most about 1e5."""

PRESETS = {
    "press": preset("seven-bar-press", friction=0.1),
    "slider-crank": preset("slider-crank"),
    "bouncing-journal": preset("bouncing-journal"),
    "pendulum": preset("pendulum"),
}


def eccentric(instant: Instant) -> bool:
    """Whether every normal is defined; a centred journal's is the direction of a rounding error."""
    contacts = instant.reduced().contacts.values()
    return all(math.hypot(*contact.eccentricity) > 1e-5 for contact in contacts)


anything = st.one_of(
    instants(trees()),
    near_start(PRESETS["press"], 1e-3),
    near_start(PRESETS["slider-crank"], 1e-3),
    near_start(PRESETS["bouncing-journal"], 2e-3),
).filter(eccentric)


def vectors(motion: Motion) -> dict[str, tuple[float, float]]:
    found = {f"{name} velocity": body.velocity for name, body in motion.bodies.items()}
    found |= {f"{name} acceleration": body.acceleration for name, body in motion.bodies.items()}
    found |= {f"{name} force": force for name, force in motion.joint_force.items()}
    found |= {f"{name} gap": contact.eccentricity for name, contact in motion.contacts.items()}
    return found


def turning(motion: Motion) -> dict[str, float]:
    """Return what changes its sign in a mirror."""
    found = {f"{name} spin": body.spin for name, body in motion.bodies.items()}
    found |= {f"{name} alpha": body.angular_acceleration for name, body in motion.bodies.items()}
    for name, contact in motion.contacts.items():
        found |= {f"{name} F_t": contact.friction_force, f"{name} slip": contact.slip_velocity}
    return found


def scalars(motion: Motion, scene: Scene, sense: float) -> dict[str, float]:
    """Return what a mirror leaves alone; torques of revolute drivers times `sense`."""
    found = {}
    for name, effort in motion.driver_effort.items():
        found[f"{name} effort"] = effort * (sense if turns(scene, scene.drivers[name]) else 1.0)
    for name, contact in motion.contacts.items():
        found[f"{name} F_n"] = contact.normal_force
        found[f"{name} penetration"] = contact.penetration
        found[f"{name} power"] = contact.contact_power + contact.friction_loss
    return found


def assert_alike(one: dict[str, object], two: dict[str, object]) -> None:
    assert one.keys() == two.keys()
    scale = max([1.0, *(float(np.abs(np.asarray(v)).max()) for v in one.values())])
    for name, value in one.items():
        np.testing.assert_allclose(value, two[name], rtol=0, atol=CLOSE * scale, err_msg=name)


@given(anything, numbers(-3.0, 3.0))
def test_a_turned_scene_moves_alike_in_the_turned_frame(instant: Instant, angle: float) -> None:
    for formulation in ("reduced", "lagrange"):
        here = getattr(instant, formulation)()
        there = getattr(turned(instant, angle), formulation)()
        expected = {name: turn(vector, angle) for name, vector in vectors(here).items()}
        assert_alike(expected, vectors(there))
        assert_alike(turning(here), turning(there))
        assert_alike(scalars(here, instant.scene, 1.0), scalars(there, instant.scene, 1.0))


@given(instants(trees()).filter(eccentric), st.tuples(numbers(-10.0, 10.0), numbers(-10.0, 10.0)))
def test_a_translated_scene_moves_alike(instant: Instant, by: tuple[float, float]) -> None:
    here = instant.reduced()
    position = dict(instant.position)
    for name in position:
        if name.endswith((".x", ".y")):
            position[name] += by[name.endswith(".y")]
    there = Instant(
        translated(instant.scene, by),
        position,
        instant.speed,
        instant.driven,
        instant.mode,
        instant.impact_rate,
    ).reduced()
    assert_alike(vectors(here), vectors(there))
    assert_alike(turning(here), turning(there))


@given(anything)
def test_a_mirrored_scene_moves_as_the_mirror_image(instant: Instant) -> None:
    for formulation in ("reduced", "lagrange"):
        here = getattr(instant, formulation)()
        there = getattr(mirrored(instant), formulation)()
        assert_alike({n: flip(v) for n, v in vectors(here).items()}, vectors(there))
        assert_alike({n: -v for n, v in turning(here).items()}, turning(there))
        assert_alike(scalars(here, instant.scene, -1.0), scalars(there, instant.scene, 1.0))


def poses(scene: Scene) -> dict[str, object]:
    found = assemble(scene)
    return {
        name: [*found.pose[3 * i : 3 * i + 3], *found.velocity[3 * i : 3 * i + 3]]
        for i, name in enumerate(scene.bodies)
    }


def with_start_angles(scene: Scene) -> Scene:
    """Return the scene with the angles of its own assembly as start angles."""
    pose = assemble(scene).pose
    angles = {name: float(pose[3 * i + 2]) for i, name in enumerate(scene.bodies)}
    start = scene.start.model_copy(update={"angles": angles})
    return scene.model_copy(update={"start": start})


@given(st.one_of(trees(), st.sampled_from(list(PRESETS.values()))), st.randoms())
def test_assembly_does_not_depend_on_the_order_of_the_document(
    scene: Scene, shuffler: random.Random
) -> None:
    """Given the angles of what the ideal mechanism leaves free: which body's angle is zero there
    is a matter of the order."""
    scene = with_start_angles(scene)
    bodies, joints = list(scene.bodies), list(scene.joints)
    shuffler.shuffle(bodies)
    shuffler.shuffle(joints)
    other = reordered(scene, bodies, joints)
    one, two = assemble(scene), assemble(other)
    assert (one.constraints, one.rank, one.freedom, one.freedom_with_play) == (
        two.constraints,
        two.rank,
        two.freedom,
        two.freedom_with_play,
    )
    assert_alike(poses(scene), poses(other))
    assert_alike(vectors(at_start(scene).reduced()), vectors(at_start(other).reduced()))


@given(trees())
def test_a_scene_survives_json(scene: Scene) -> None:
    text = scene.model_dump_json()
    assert Scene.model_validate_json(text) == scene
    assert Scene.model_validate(json.loads(json.dumps(scene.model_dump()))) == scene


@pytest.mark.parametrize("name", presets.names())
def test_every_preset_survives_json(name: str) -> None:
    scene = Scene.model_validate(presets.document(name))
    assert Scene.model_validate_json(scene.model_dump_json()) == scene


@pytest.mark.parametrize("name", presets.names())
def test_every_preset_closes_to_rounding_with_the_freedom_it_should_have(name: str) -> None:
    found = assemble(Scene.model_validate(presets.document(name)))
    expected = {
        "seven-bar-press": (0, 4),
        "seven-bar-press-fitted": (0, 4),
        "seven-bar-press-punching": (0, 4),
        "slider-crank": (0, 2),
        "bouncing-journal": (1, 3),
        "pendulum": (1, 1),
        "andrews-squeezer": (1, 1),
        "double-four-bar": (1, 1),
        "quick-return": (0, 2),
        "jansen-leg": (0, 2),
        "seven-bar-test-bed": (0, 4),
        "four-bar": (0, 2),
        "n-four-bar": (1, 1),
        "double-pendulum": (2, 2),
        "driven-pendulum": (1, 1),
        "impact-oscillator": (0, 1),
    }
    assert (found.freedom, found.freedom_with_play) == expected[name]
    assert found.residual <= 1e-15  # lengths up to 2 m add up to a few roundings
    # where the oscillator's mass starts in its stop, its guide says, too
    assert found.redundant == (name == "impact-oscillator")
    assert found.redundant_with_play == 0
