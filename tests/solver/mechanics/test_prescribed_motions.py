"""Drivers that follow functions of time: position, speed and acceleration enter the equations."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings

from jointplay.records.failure import InvalidInput
from jointplay.solver.kinds import admit
from jointplay.solver.runs.ideal.following import follow
from jointplay.solver.runs.simulate import Simulation
from jointplay.solver.scene import presets
from jointplay.solver.scene.clocks import clocks
from jointplay.solver.scene.periods import common_period
from jointplay.solver.scene.time_scales import characteristic_time, driven_speed
from tests.solver.completed_runs import collect, run
from tests.solver.driven_motions import carried, function, independent, moved
from tests.solver.mechanics.test_mechanics import anywhere, assert_formulations_agree
from tests.solver.readable_mechanics import Instant, at_start, scene_of

SINE = {"type": "sinusoidal", "amplitude": 0.7, "frequency": 5.0, "phase": 0.4}
START_UP = {"type": "start-up", "speed": 6.0, "length": 0.8}
HELD = {
    "type": "table",
    "knots": [0.0, 0.3, 0.7, 1.0, 1.6],
    "values": [0.0, 1.0, 0.2, -1.0, 0.5],
    "between": "smooth",
    "outside": "held",
}


@settings(max_examples=40)
@given(moved(anywhere))
def test_joint_coordinates_and_multipliers_agree_where_drivers_accelerate(instant: Instant) -> None:
    assert_formulations_agree(instant)


@pytest.mark.parametrize(
    ("motion", "kind", "kinks"),
    [(SINE, "prismatic", ()), (START_UP, "revolute", (0.8,))],
    ids=["a slider shaken periodically", "a crank that starts up"],
)
def test_a_pendulum_on_a_moving_carrier_swings_as_its_equation_says(
    motion: dict, kind: str, kinks: tuple[float, ...]
) -> None:
    found = run(carried(motion, kind), 4.0, tolerance=1e-9, output_step=0.25)
    start = found["bob.theta"][0], found["bob.omega"][0]
    expected = independent(motion, kind, found.time, start, kinks)
    # local errors of 1e-9 of the scales, 300 steps, and a swing that multiplies them a hundredfold
    np.testing.assert_allclose(found["bob.theta"], expected, rtol=0, atol=3e-7)
    moved_as = function(motion).at(found.time)
    channel = "carrier.theta" if kind == "revolute" else "carrier.x"
    assert found[channel] - found[channel][0] == pytest.approx(
        moved_as.value - moved_as.value[0], abs=1e-12
    )
    energy = found.statistics["energy"]
    assert abs(energy["residual"]) <= 1e-8 * energy["gross_work"]
    gained = found["energy.kinetic"] + found["energy.potential"]
    assert gained[-1] - gained[0] == pytest.approx(energy["driver_work"], abs=1e-6)


def test_an_ideal_crank_follows_a_table_and_needs_the_torque_that_accelerates_it() -> None:
    scene = carried(HELD)
    scene["joints"]["P"] = {"type": "fixed", "base": "carrier.P", "part": "bob.P"}
    scene["gravity"] = [0.0, 0.0]
    found = run(scene, 2.0, output_step=0.01)
    motion = function(HELD).at(found.time)
    np.testing.assert_allclose(found["carrier.theta"], motion.value, rtol=0, atol=1e-12)
    np.testing.assert_allclose(found["carrier.omega"], motion.slope, rtol=0, atol=1e-11)
    inertia = 0.1 + 1.0 * 0.1**2 + 0.02 + 1.5 * 0.6**2  # about the pin, by Steiner
    expected = inertia * motion.curvature
    np.testing.assert_allclose(found["motor.torque"], expected, rtol=0, atol=1e-9)
    np.testing.assert_allclose(found["motor.power"], expected * motion.slope, rtol=0, atol=1e-8)


def test_an_ideal_crank_that_starts_up_has_sections_after_the_scenes_own_period() -> None:
    scene = carried(START_UP) | {"period": 0.3}
    scene["joints"]["P"] = {"type": "fixed", "base": "carrier.P", "part": "bob.P"}
    found = run(scene, 2.0)
    np.testing.assert_allclose(found.section_time, 0.3 * np.arange(7), rtol=1e-15)
    expected = function(START_UP).at(found.section_time).value  # nothing repeats
    np.testing.assert_allclose(found.sections["carrier.theta"], expected, rtol=0.0, atol=1e-12)


def test_periods_and_scales_of_time_are_those_of_the_motion() -> None:
    sine = scene_of(carried(SINE))
    assert common_period(sine).seconds == pytest.approx(2.0 * np.pi / 5.0, rel=1e-14)
    assert clocks(sine)["motor"].turn == pytest.approx(2.0 * np.pi / 5.0, rel=1e-14)
    assert characteristic_time(sine, 0.3) == pytest.approx(2.0 * np.pi / 5.0, rel=1e-14)
    # of 0.7 rad sin(5 t) the first derivative counts: 0.7 * 5 < (0.7 * 5^6)^(1/6)
    assert driven_speed(sine, 0.3, 1.0) == pytest.approx(5.0 * 0.7 ** (1 / 6), rel=1e-12)
    start_up = scene_of(carried(START_UP))
    assert common_period(start_up).seconds is None
    assert "never repeats" in common_period(start_up).note
    assert characteristic_time(start_up, 0.3) == pytest.approx(0.8)
    mixed = carried(SINE)
    mixed["drivers"]["second"] = {"joint": "P", "speed": 10.0 / 3.0}
    assert common_period(scene_of(mixed)).seconds == pytest.approx(3.0 * 2.0 * np.pi / 5.0)


@pytest.mark.parametrize("coefficients", [[0.0, 0.3], [0.0, 0.0, 2.0], [0.0, 1e-8, 0.0, 1.0]])
def test_a_polynomial_moves_a_mechanism_that_is_followed(coefficients: list[float]) -> None:
    times = [0.0, 0.7, 1.4]
    motion = {"type": "polynomial", "coefficients": coefficients}
    for kind, column in (("revolute", 2), ("prismatic", 0)):
        poses = follow(scene_of(carried(motion, kind)), times).poses
        moved = np.polynomial.polynomial.polyval(times, coefficients)
        np.testing.assert_allclose(poses[:, column] - poses[0, column], moved, atol=1e-12)


def test_a_polynomial_that_starts_almost_at_rest_is_as_fast_as_after_a_radian() -> None:
    """Its slope at the start, 1e-8 rad/s, would make a revolution last twenty years."""
    motion = {"type": "polynomial", "coefficients": [0.0, 1e-8, 2.0]}
    scene = scene_of(carried(motion))
    assert characteristic_time(scene, 0.3) == pytest.approx(2.0 * np.pi / (2.0 * 2.0**0.5))
    found = run(carried(motion), 2.0, tolerance=1e-8, output_step=0.25)
    expected = independent(motion, "revolute", found.time, (-1.0, found["bob.omega"][0]))
    np.testing.assert_allclose(found["bob.theta"], expected, rtol=0.0, atol=1e-6)


def test_a_motion_of_amplitude_zero_needs_no_period_in_common_with_another() -> None:
    mixed = carried(SINE | {"amplitude": 0.0})
    still = common_period(scene_of(mixed)).seconds  # where a study of amplitudes begins
    assert still == pytest.approx(2.0 * np.pi / 5.0, rel=1e-14)
    mixed["drivers"]["second"] = {"joint": "P", "speed": 10.0 / 3.0}
    assert common_period(scene_of(mixed)).seconds == pytest.approx(3.0 * 2.0 * np.pi / 5.0)
    mixed["drivers"]["second"]["speed"] = 5.0 * np.sqrt(2.0)
    found = common_period(scene_of(mixed)).seconds
    assert found == pytest.approx(np.sqrt(2.0) * np.pi / 5.0, rel=1e-14)
    mixed["drivers"]["motor"]["motion"]["amplitude"] = 1e-9
    assert common_period(scene_of(mixed)).seconds is None


@pytest.mark.parametrize(
    ("driver", "pointer", "words"),
    [
        ({"motion": {"type": "sine"}}, "/motion/type", "'sinusoidal'"),
        ({"motion": SINE | {"frequency": 0.0}}, "/motion/frequency", "at least 1e-09"),
        ({"motion": HELD | {"knots": [0.0, 0.3, 0.2, 1.0, 1.6]}}, "/motion/knots", "Knot 2"),
        ({"motion": HELD | {"between": "monotone"}}, "/motion/between", "'smooth'"),
        ({"motion": SINE, "speed": 1.0}, "/speed", "'speed' does not go with the others"),
        ({}, "/speed", "required"),
    ],
)
def test_a_motion_that_cannot_be_followed_is_refused_at_its_field(
    driver: dict, pointer: str, words: str
) -> None:
    scene = carried(SINE)
    scene["drivers"]["motor"] = {"joint": "J"} | driver
    with pytest.raises(InvalidInput) as refused:
        admit({"kind": "simulate", "scene": scene, "duration": 1.0})
    (problem,) = refused.value.problems
    assert problem.pointer == f"/scene/drivers/motor{pointer}"
    assert words in problem.detail


def test_a_study_varies_a_motion_and_its_period() -> None:
    scene = carried(SINE)
    target = {"path": "/drivers/motor/motion/frequency"}
    scene["parameters"] = {"w": {"help": "Frequency.", "unit": "rad/s", "targets": [target]}}
    job = {"kind": "sweep", "scene": scene, "grid": {"w": [4.0, 5.0]}, "periods": 2}
    assert admit(job).period.tolist() == pytest.approx([2.0 * np.pi / w for w in (4.0, 5.0)])
    with pytest.raises(InvalidInput) as refused:
        admit(job | {"grid": {"w": [4.0, -1.0]}})
    assert "at least 1e-09" in str(refused.value)


def turned(motion: dict, *, play: bool) -> dict:
    """Return a pendulum on a free crank, its own angle prescribed whatever its joint."""
    scene = carried(motion)
    scene["drivers"]["motor"] = {"body": "bob", "motion": motion}
    if play:
        scene["joints"]["P"]["clearance"] = {
            "radial_clearance": 0.01,
            "bearing_radius": 0.05,
            "contact": {"stiffness": 1e7, "restitution": 0.8},
        }
    return scene


@pytest.mark.parametrize("play", [False, True])
@pytest.mark.parametrize("seed", range(4))
def test_a_body_is_turned_from_the_ground_whatever_its_joint(play: bool, seed: int) -> None:
    random = np.random.default_rng(seed)
    start = at_start(scene_of(turned(SINE, play=play)))
    instant = replace(
        start,
        position={name: random.normal() for name in start.position},
        speed={name: random.normal() for name in start.speed},
        driven={name: random.normal() for name in start.driven},
        mode=dict.fromkeys(start.mode, 1.0),
    )
    assert ("bob.x" in start.position) == play
    assert "bob.theta" not in start.position
    assert_formulations_agree(instant)
    motion = instant.reduced()
    expected = function(SINE).at(instant.driven["motor"])
    assert (motion.bodies["bob"].spin, motion.bodies["bob"].angular_acceleration) == pytest.approx(
        expected[1:], rel=1e-12
    )


@pytest.mark.parametrize(
    ("driver", "pointer", "words"),
    [
        ({"body": "bobb"}, "/body", "'bob'"),
        ({"body": "bob", "joint": "J"}, "/joint", "not both"),
        ({"joint": None}, "/joint", "'joint' or a 'body'"),
        ({"body": "carrier"}, "/body", "joint 'J' holds it"),
    ],
)
def test_a_body_that_cannot_be_turned_is_refused(driver: dict, pointer: str, words: str) -> None:
    scene = carried(SINE, "prismatic")
    scene["drivers"]["motor"] = {"motion": SINE} | driver
    with pytest.raises(InvalidInput) as refused:
        admit({"kind": "simulate", "scene": scene, "duration": 1.0})
    (problem,) = refused.value.problems
    assert problem.pointer == f"/scene/drivers/motor{pointer}"
    assert words in problem.detail


@pytest.mark.long
@pytest.mark.parametrize("formulation", ["reduced", "lagrange"])
def test_a_slider_crank_with_play_in_all_three_pins_is_driven(formulation: str) -> None:
    play = {"clearance": 5e-4, "clearance_O": 5e-4, "clearance_Q": 5e-4}
    scene = {"preset": "slider-crank", "parameters": play}
    found = run(scene, 0.012, formulation=formulation, tolerance=1e-8, output_step=1e-3)
    speed = presets.document("slider-crank")["drivers"]["motor"]["speed"]
    np.testing.assert_allclose(found["crank.theta"], speed * found.time, rtol=1e-9, atol=1e-15)
    energy = found.statistics["energy"]
    assert found.statistics["onsets"] >= 3
    assert abs(energy["residual"]) <= 10.0 * 1e-8 * energy["gross_work"]


def test_the_certificate_of_a_journal_on_a_crank_that_starts_up_covers_its_errors() -> None:
    scene = carried(START_UP)
    scene["joints"]["P"]["clearance"] = {
        "radial_clearance": 0.002,
        "bearing_radius": 0.02,
        "contact": {"stiffness": 1e8, "restitution": 0.6},
    }
    finer = run(scene, 1.0, tolerance=1e-10, output_step=0.02)
    job = {"kind": "simulate", "scene": scene, "duration": 1.0, "tolerance": 1e-7}
    admission = admit(job | {"output_step": 0.02})
    simulation = Simulation(admission)
    found = collect(admission, list(simulation.slices()), simulation)
    certificate = simulation.certificate()
    assert certificate is not None
    assert found.statistics["onsets"] > 5
    names = [channel.name for channel in admission.channels]
    for name in ("bob.theta", "bob.omega", "P.eccentricity_x"):
        estimated = np.interp(found.time, certificate.time, certificate.error[:, names.index(name)])
        assert np.all(np.abs(found[name] - finer[name]) <= estimated + 1e-12)


@pytest.mark.parametrize("formulation", ["reduced", "lagrange"])
def test_a_body_driven_by_its_joint_and_against_the_ground_moves_what_carries_it(
    formulation: str,
) -> None:
    # the angle of the crank is that of the rod less that of the joint, whatever hangs beside it
    ends = {"a": [-0.2, 0.0], "b": [0.2, 0.0]}
    scene = {
        "name": "driven-twice",
        "gravity": [0.0, -9.81],
        "ground": {"points": {"O": [0.0, 0.0], "Q": [1.0, 0.0]}},
        "bodies": {
            name: {"mass": 1.0, "inertia": 0.02, "points": ends} for name in ("crank", "rod", "bob")
        },
        "joints": {
            name: {"type": "revolute", "bearing": bearing, "journal": journal}
            for name, bearing, journal in (
                ("O", "ground.O", "crank.a"),
                ("P", "crank.b", "rod.a"),
                ("Q", "ground.Q", "bob.a"),
            )
        },
        "drivers": {
            "joint": {"joint": "P", "position": 0.5, "speed": 2.0},
            "body": {"body": "rod", "position": 0.2, "motion": SINE},
        },
        "start": {"angles": {"crank": -0.3}},
    }
    found = run(scene, 4.0, tolerance=1e-9, formulation=formulation)
    sine = 0.2 + 0.7 * np.sin(5.0 * found.time + 0.4)
    np.testing.assert_allclose(found["rod.theta"], sine, rtol=0, atol=1e-9)
    crank = sine - 0.5 - 2.0 * found.time
    np.testing.assert_allclose(found["crank.theta"], crank, rtol=0, atol=1e-7)
    energy = found.statistics["energy"]
    assert abs(energy["residual"]) <= 1e-6 * energy["gross_work"]


@pytest.mark.parametrize("free", [False, True], ids=["driven alone", "beside what moves freely"])
@pytest.mark.parametrize(
    ("knots", "outside", "found"),
    [
        ([0.0, 1.0, 2.0], "held", [2.0, 2.0, 2.0, -2.0, -2.0, 0.0, 0.0]),
        ([0.5, 1.5, 2.5], "held", [0.0, 2.0, 2.0, 2.0, -2.0, -2.0, 0.0]),
        ([0.0, 1.0, 2.0], "periodic", [2.0, 2.0, 2.0, -2.0, 2.0, 2.0, 2.0]),
    ],
    ids=["held", "held from its first knot on", "periodic"],
)
def test_samples_at_jumps_have_the_value_before_but_where_a_function_begins(
    free: bool, knots: list[float], outside: str, found: list[float]
) -> None:
    pieces = [[0.0, 0.0, 1.0], [1.0, 2.0, -1.0]]
    if outside == "periodic":  # forth and back
        pieces = [[0.0, -1.0, 1.0], [0.0, 1.0, -1.0]]
    motion = {
        "type": "piecewise-polynomial",
        "knots": knots,
        "coefficients": pieces,
        "outside": outside,
    }
    scene = carried(motion, "prismatic")
    if not free:
        scene["bodies"].pop("bob")
        scene["joints"] = {"J": scene["joints"]["J"]}
        scene.pop("start", None)
    run_of = run(scene, 3.0, output_step=0.5)
    np.testing.assert_allclose(run_of["carrier.ax"], found, rtol=0, atol=1e-12)
