"""Force elements: power, oscillations in closed form, the energy ledger, what is refused."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from jointplay.records.failure import InvalidInput
from jointplay.solver.kinds import admit
from jointplay.solver.laws.force import ELEMENTS, Ends
from jointplay.solver.laws.force.force import Force
from jointplay.solver.laws.force.motor import Motor
from jointplay.solver.laws.force.spring_damper import SpringDamper
from jointplay.solver.laws.force.tension import Tension
from jointplay.solver.laws.force.torque import Torque
from jointplay.solver.laws.force.torsion_spring import TorsionSpring
from tests.solver.completed_runs import Run, run
from tests.solver.laws.specification.element import ElementSpecification

MASS, STIFFNESS, FREE_LENGTH = 2.0, 50.0, 0.4
RATE = math.sqrt(STIFFNESS / MASS)
formulations = pytest.mark.parametrize("formulation", ["reduced", "lagrange"])
by_multipliers = pytest.mark.parametrize(
    "formulation", [pytest.param("reduced", marks=pytest.mark.long), "lagrange"]
)
"""Elements act on bodies alike in both: the short suite compiles one test's motion in both."""


class TestSpringDamper(ElementSpecification):
    model = SpringDamper
    elements = st.builds(
        SpringDamper,
        type=st.just("spring-damper"),
        first=st.just("ground.O"),
        second=st.just("mass.eye"),
        stiffness=st.floats(0.0, 1e6),
        damping=st.floats(0.0, 1e3),
        free_length=st.floats(0.0, 2.0),
    )


class TestTorque(ElementSpecification):
    model = Torque
    elements = st.builds(
        Torque,
        type=st.just("torque"),
        first=st.just("ground.O"),
        second=st.just("mass.eye"),
        moment=st.floats(-1e3, 1e3),
    )


class TestForce(ElementSpecification):
    model = Force
    elements = st.builds(
        Force,
        type=st.just("force"),
        first=st.just("ground.O"),
        second=st.just("mass.eye"),
        magnitude=st.floats(-1e3, 1e3),
        direction=st.sampled_from([[1.0, 0.0], [0.0, -2.0], [0.3, -0.4]]),
        axes=st.sampled_from(["world", "first", "second"]),
    )


class TestTension(ElementSpecification):
    model = Tension
    elements = st.builds(
        Tension,
        type=st.just("tension"),
        first=st.just("ground.O"),
        second=st.just("mass.eye"),
        magnitude=st.floats(-1e3, 1e3),
    )


class TestMotor(ElementSpecification):
    model = Motor
    elements = st.builds(
        Motor,
        type=st.just("motor"),
        first=st.just("ground.O"),
        second=st.just("mass.eye"),
        stall_torque=st.floats(1e-3, 1e3),
        no_load_speed=st.floats(1e-2, 1e3),
    )


class TestTorsionSpring(ElementSpecification):
    model = TorsionSpring
    elements = st.builds(
        TorsionSpring,
        type=st.just("torsion-spring"),
        first=st.just("ground.O"),
        second=st.just("mass.eye"),
        stiffness=st.floats(0.0, 1e6),
        damping=st.floats(0.0, 1e3),
        free_angle=st.floats(-3.0, 3.0),
    )


def test_every_element_in_the_registry_is_specified() -> None:
    specified = {each.model for each in ElementSpecification.__subclasses__()}
    assert set(ELEMENTS.values()) <= specified


@given(x=st.floats(0.1, 1.0), y=st.floats(-1.0, 1.0), vx=st.floats(-1.0, 1.0))
def test_a_tension_that_is_linear_in_the_distance_is_a_spring(
    x: float, y: float, vx: float
) -> None:
    ends = {"first": "ground.O", "second": "mass.eye"}
    spring = SpringDamper(type="spring-damper", **ends, stiffness=50.0, free_length=0.4)
    course = {"type": "polynomial", "coefficients": [-0.4, 1.0]}
    tension = Tension.model_validate(
        {"type": "tension", **ends, "magnitude": 50.0, "course": course}
        | {"over": {"quantity": "distance"}}
    )
    length = math.hypot(x, y)
    here = Ends((x, y), (vx, 0.3), (0.0, 0.0), argument=length)
    one, other = spring.effect(here), tension.effect(here)
    assert one.force == pytest.approx(other.force, abs=1e-13)  # rounding of 50 N
    assert one.channels == pytest.approx(other.channels, abs=1e-13)
    rate = other.channels["rate"]
    assert other.loss == pytest.approx(50.0 * (length - 0.4) * rate, abs=1e-13)


def oscillator(**element: Any) -> dict[str, Any]:
    """Return a mass that slides along x on a spring; its eye starts at the origin, 0.5 m from O."""
    spring = {"type": "spring-damper", "first": "ground.O", "second": "mass.eye"}
    return {
        "name": "oscillator",
        "ground": {"points": {"O": [-0.5, 0.0], "guide": [0.0, 0.0]}},
        "bodies": {"mass": {"mass": MASS, "inertia": 1.0, "points": {"eye": [0.0, 0.0]}}},
        "joints": {
            "slide": {
                "type": "prismatic",
                "guide": "ground.guide",
                "slider": "mass.eye",
                "axis": [1.0, 0.0],
            }
        },
        "forces": {
            "spring": spring | {"stiffness": STIFFNESS, "free_length": FREE_LENGTH} | element
        },
    }


def computed(scene: dict[str, Any], duration: float, formulation: str) -> Run:
    return run(scene, duration, tolerance=1e-9, formulation=formulation, output_step=0.01)


@formulations
def test_a_mass_on_a_spring_swings_at_its_natural_frequency(formulation: str) -> None:
    found = computed(oscillator(), 3.0, formulation)
    stretch = 0.1 * np.cos(RATE * found.time)
    # tolerance 1e-9 a step of local error, relative to 1 m/s, over some thousand steps at most
    np.testing.assert_allclose(found["mass.x"], stretch - 0.1, atol=1e-7)
    np.testing.assert_allclose(found["spring.length"], FREE_LENGTH + stretch, atol=1e-7)
    np.testing.assert_allclose(found["spring.force"], STIFFNESS * stretch, atol=5e-6)
    np.testing.assert_allclose(
        found["spring.rate"], -0.1 * RATE * np.sin(RATE * found.time), atol=1e-6
    )
    energy = found.statistics["energy"]
    assert energy["element_loss"] == pytest.approx(0.0, abs=1e-8)
    total = found["energy.kinetic"] + 0.5 * STIFFNESS * stretch**2
    np.testing.assert_allclose(total, 0.5 * STIFFNESS * 0.1**2, atol=1e-6)


@by_multipliers
def test_a_damper_lets_it_decay_and_the_ledger_says_where_the_energy_went(formulation: str) -> None:
    damping = 4.0
    found = computed(oscillator(damping=damping), 3.0, formulation)
    decay = damping / (2.0 * MASS)
    rate = math.sqrt(RATE**2 - decay**2)
    t = found.time
    stretch = 0.1 * np.exp(-decay * t) * (np.cos(rate * t) + decay / rate * np.sin(rate * t))
    np.testing.assert_allclose(found["mass.x"], stretch - 0.1, atol=1e-7)
    energy = found.statistics["energy"]
    left = found["energy.kinetic"][-1] + 0.5 * STIFFNESS * stretch[-1] ** 2
    assert energy["element_loss"] == pytest.approx(0.5 * STIFFNESS * 0.1**2 - left, abs=1e-7)
    assert energy["contact_loss"] == pytest.approx(0.0, abs=1e-7)
    assert abs(energy["residual"]) <= 1e-7 * energy["gross_work"]


@by_multipliers
def test_springs_alone_hold_a_body_that_no_joint_holds(formulation: str) -> None:
    """A body on two equal springs, aside of the pendulum that every scene's joint needs."""
    scene = oscillator()
    scene["gravity"] = [0.0, -9.81]
    scene["ground"]["points"] |= {"left": [1.0, 1.0], "right": [3.0, 1.0]}
    scene["bodies"]["load"] = {
        "mass": MASS,
        "inertia": 0.1,
        "points": {"eye": [0.0, 0.0], "tip": [0.0, 0.1]},
    }
    for side in ("left", "right"):
        scene["forces"][side] = {
            "type": "spring-damper",
            "first": f"ground.{side}",
            "second": "load.eye",
            "stiffness": STIFFNESS,
        }
    found = computed(scene, 1.0, formulation)
    # without a free length both springs pull to their middle: x is harmonic about 2 m, y about
    # the height where they bear the weight; the body starts at the origin
    swing = math.sqrt(2.0 * STIFFNESS / MASS)
    sag = 1.0 - MASS * 9.81 / (2.0 * STIFFNESS)
    np.testing.assert_allclose(found["load.x"], 2.0 * (1.0 - np.cos(swing * found.time)), atol=2e-6)
    np.testing.assert_allclose(found["load.y"], sag * (1.0 - np.cos(swing * found.time)), atol=2e-6)
    np.testing.assert_allclose(found["load.theta"], 0.0, atol=1e-9)


def test_the_driver_of_an_ideal_mechanism_works_against_a_spring() -> None:
    """No freedom: inverse dynamics must give the spring's moment about the crank's pin."""
    scene = {
        "name": "wound-crank",
        "ground": {"points": {"O": [0.0, 0.0], "hook": [2.0, 0.0]}},
        "bodies": {
            "crank": {"mass": 1.0, "inertia": 1.0, "points": {"O": [0.0, 0.0], "pin": [1.0, 0.0]}}
        },
        "joints": {"bearing": {"type": "revolute", "bearing": "ground.O", "journal": "crank.O"}},
        "drivers": {"motor": {"joint": "bearing", "speed": 2.0}},
        "forces": {
            "spring": {
                "type": "spring-damper",
                "first": "ground.hook",
                "second": "crank.pin",
                "stiffness": STIFFNESS,
                "damping": 3.0,
                "free_length": 0.5,
            }
        },
    }
    found = run(scene, 3.0)
    angle = 2.0 * found.time
    length = np.sqrt(5.0 - 4.0 * np.cos(angle))
    rate = 4.0 * np.sin(angle) / length  # d/dt of 5 - 4 cos(angle), over 2 length
    np.testing.assert_allclose(found["spring.length"], length, rtol=1e-12)
    tension = STIFFNESS * (length - 0.5) + 3.0 * rate
    np.testing.assert_allclose(found["spring.force"], tension, rtol=1e-10)
    # the motor supplies the power that the tension takes: T dL/dt = torque * speed
    np.testing.assert_allclose(found["motor.torque"] * 2.0, tension * rate, atol=1e-9)


@by_multipliers
def test_a_torque_spins_one_body_up_against_another(formulation: str) -> None:
    """Two wheels on one axle: each gets the torque, in opposite directions."""
    moment, inertias = 0.3, {"rotor": 0.2, "stator": 0.5}
    wheels = {
        name: {"mass": 1.0, "inertia": inertia, "points": {"O": [0.0, 0.0]}}
        for name, inertia in inertias.items()
    }
    bearings = {
        f"bearing_{name}": {"type": "revolute", "bearing": "ground.O", "journal": f"{name}.O"}
        for name in wheels
    }
    motor = {"type": "torque", "first": "stator.O", "second": "rotor.O", "moment": moment}
    scene = {
        "name": "wheels",
        "ground": {"points": {"O": [0.0, 0.0]}},
        "bodies": wheels,
        "joints": bearings,
        "forces": {"motor": motor},
    }
    found = computed(scene, 2.0, formulation)
    for name, sense in (("rotor", 1.0), ("stator", -1.0)):
        rate = sense * moment / inertias[name]
        np.testing.assert_allclose(found[f"{name}.theta"], 0.5 * rate * found.time**2, atol=1e-7)
    work = 0.5 * (moment * 2.0) ** 2 * sum(1.0 / inertia for inertia in inertias.values())
    energy = found.statistics["energy"]
    assert energy["element_loss"] == pytest.approx(-work, rel=1e-7)
    assert energy["kinetic_change"] == pytest.approx(work, rel=1e-7)


@pytest.mark.parametrize(
    ("element", "pointer", "words"),
    [
        ({"type": None}, "/type", "'type' must be 'spring-damper'"),
        ({"type": "rope"}, "/type", "'spring-damper'"),
        ({"second": "mass.nose"}, "/second", "point of 'mass'"),
        ({"second": "mas.eye"}, "/second", "'mass'"),
        ({"second": "ground.guide"}, "", "a force acts between two bodies"),
        ({"stiffness": -1.0}, "/stiffness", "'stiffness' must be at least 0 N/m, not -1."),
        ({"elasticity": 1.0}, "/elasticity", "no field"),
        ({"first": "ground.guide"}, "", "coincide at the start"),
    ],
)
def test_an_element_that_cannot_act_is_refused_at_its_field(
    element: dict[str, Any], pointer: str, words: str
) -> None:
    with pytest.raises(InvalidInput) as refused:
        admit({"kind": "simulate", "scene": oscillator(**element), "duration": 1.0})
    (problem,) = refused.value.problems
    assert problem.pointer == f"/scene/forces/spring{pointer}"
    assert words in problem.detail


def test_a_spring_whose_stiffness_was_forgotten_is_refused() -> None:
    scene = oscillator()
    del scene["forces"]["spring"]["stiffness"]
    with pytest.raises(InvalidInput, match="A stiffness of 0 measures the distance"):
        admit({"kind": "simulate", "scene": scene, "duration": 1.0})


def test_a_tension_has_no_direction_where_its_points_meet() -> None:
    scene = oscillator()
    ends = {"first": "ground.guide", "second": "mass.eye"}
    scene["forces"] = {"magnet": {"type": "tension", "magnitude": 1.0} | ends}
    with pytest.raises(InvalidInput, match="coincide at the start"):
        admit({"kind": "simulate", "scene": scene, "duration": 1.0})


def test_points_that_meet_at_the_start_need_no_direction_without_a_free_length() -> None:
    scene = oscillator(first="ground.guide", free_length=0.0)
    np.testing.assert_allclose(run(scene, 1.0)["mass.x"], 0.0, atol=1e-12)


def test_springs_without_stiffness_measure_and_exert_nothing() -> None:
    """A pendulum that turns over: its end passes a point in its way, and its angle has no end."""
    ends = {"first": "ground.O", "second": "rod.O", "stiffness": 0.0}
    end = {"first": "ground.low", "second": "rod.low", "stiffness": 0.0, "free_length": 0.1}
    scene = {
        "name": "pendulum",
        "ground": {"points": {"O": [0.0, 0.0], "low": [0.0, -1.0]}},
        "bodies": {
            "rod": {"mass": 1.0, "inertia": 0.1, "points": {"O": [0.0, 0.5], "low": [0.0, -0.5]}}
        },
        "joints": {"pin": {"type": "revolute", "bearing": "ground.O", "journal": "rod.O"}},
        "gravity": [0.0, -9.81],
        "start": {"angular_velocities": {"rod": 9.0}},
    }
    measures = {
        "turn": {"type": "torsion-spring", **ends},
        "way": {"type": "spring-damper", **end},
    }
    found, alone = run({**scene, "forces": measures}, 2.0), run(scene, 2.0)
    angle = found["rod.theta"]
    np.testing.assert_array_equal(angle, alone["rod.theta"])
    assert angle[-1] > 4.0 * math.pi
    np.testing.assert_array_equal(found["turn.angle"], angle)
    chord = 2.0 * np.abs(np.sin(0.5 * angle))
    np.testing.assert_allclose(found["way.length"], chord, rtol=0, atol=1e-14)
    assert found.peaks["way.length"].minimum == pytest.approx(0.0, abs=2e-6)  # 1e-6 of its range
    assert found.peaks["way.length"].maximum == pytest.approx(2.0, rel=1e-6)
    for quiet in ("turn.moment", "way.force"):
        np.testing.assert_array_equal(found[quiet], 0.0)


def test_a_parameter_may_turn_a_damper() -> None:
    scene = oscillator(damping=1.0)
    target = {"path": "/forces/spring/damping"}
    scene["parameters"] = {"c": {"help": "Damping.", "unit": "N s/m", "targets": [target]}}
    job = {"kind": "sweep", "scene": scene, "grid": {"c": [0.0, 1.0, 2.0]}, "duration": 1.0}
    assert admit(job).points == 3
    with pytest.raises(InvalidInput) as refused:
        admit(job | {"grid": {"c": [1.0, -1.0]}})
    assert "at least 0" in str(refused.value)


@given(stiffness=st.floats(1.0, 1e4))
def test_tension_pulls_the_points_together(stiffness: float) -> None:
    scene = oscillator(stiffness=stiffness)["forces"]["spring"]
    element = SpringDamper.model_validate(scene)
    found = element.effect(Ends((0.5, 0.0), (0.0, 0.0), (0.0, 0.0)))
    assert found.force == (-found.channels["force"], 0.0)
    assert found.channels["force"] == pytest.approx(stiffness * 0.1)
