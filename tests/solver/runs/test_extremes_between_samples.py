"""Reported extremes are those of a fine sampling of the same run, wherever they fall."""

from typing import Any

import numpy as np
import pytest

from tests.solver.completed_runs import run

CLOSE = 1e-6
"""Share of a channel's range; where nothing sticks and steps are as long as at tolerance 1e-6."""
NOISE = 1e-9
"""A range that is a smaller share of that of another channel of the same kind is rounding."""
ACCURACIES: tuple[dict[str, Any], ...] = (
    {"tolerance": 1e-6},
    {"tolerance": 1e-8},
    {"method": "dormand-prince-853", "tolerance": 1e-6},
)


def check(
    scene: str | dict[str, Any], duration: float, parameters: dict[str, float], **job: Any
) -> None:
    """Compare the extremes of all channels with those of 100 000 samples.

    Steps with samples are attended: those of a run with none tell what is foreseen.
    """
    found = run(scene, duration, parameters=parameters, output_step=duration / 1e5, **job)
    alone = run(scene, duration, parameters=parameters, output_step=duration, **job)
    assert alone.peaks == found.peaks
    ranges = {name: np.ptp(samples) for name, samples in found.samples.items()}
    for name, samples in found.samples.items():
        kind = name.split(".")[-1].split("_")[0]
        largest = max(r for other, r in ranges.items() if f".{kind}" in other or other == name)
        if ranges[name] <= NOISE * largest:
            continue
        peak, slack = found.peaks[name], CLOSE * ranges[name]
        assert samples.max() - peak.maximum <= slack, (name, job, parameters)
        assert peak.minimum - samples.min() <= slack, (name, job, parameters)


def test_a_pendulum_that_spins_stays_on_its_circle() -> None:
    parameters = {"gravity_y": 0.0, "angular_velocity": 1000.0}
    found = run("pendulum", 0.05, parameters=parameters)
    for name, radius in (("rod.x", 0.5), ("rod.y", 0.5), ("pivot.force_x", 5e5)):
        peak = found.peaks[name]
        assert peak.maximum == pytest.approx(radius, rel=1e-6)
        assert peak.minimum == pytest.approx(-radius, rel=1e-6)


def test_a_journal_that_passes_the_centre_slips_fastest_there() -> None:
    # on a straight line, 10 um from the centre: the slip there is the speed, the way from the wall
    # what is left of the clearance of 1 mm; a step takes a hundred times as long as the passage
    parameters = {"gravity_y": 0.0, "velocity_x": 0.2, "position_x": -9e-4, "position_y": 1e-5}
    found = run("bouncing-journal", 0.008, parameters=parameters)
    assert found.peaks["bearing.slip_velocity"].minimum == pytest.approx(-0.2, rel=1e-9)
    assert found.peaks["bearing.slip_velocity"].minimum_time == pytest.approx(4.5e-3, abs=1e-8)
    assert found.peaks["bearing.penetration"].minimum == pytest.approx(-9.9e-4, rel=1e-9)


def random_journal(rng: np.random.Generator) -> tuple[float, dict[str, float]]:
    """Return a duration and the parameters of a journal that bounces a few times in it."""
    clearance = float(10.0 ** rng.uniform(-4.0, -2.5))
    speed = float(10.0 ** rng.uniform(-1.5, 0.0))
    along, away = rng.uniform(0.0, 2.0 * np.pi, 2)
    distance = clearance * rng.uniform(0.0, 0.95)
    parameters = {
        "clearance": clearance,
        "position_x": float(distance * np.cos(away)),
        "position_y": float(distance * np.sin(away)),
        "velocity_x": float(speed * np.cos(along)),
        "velocity_y": float(speed * np.sin(along)),
        "spin": float(20.0 * rng.normal()),
        "gravity_y": float(rng.choice([0.0, -9.81])),
        "friction": 0.0,
        "restitution": float(rng.uniform(0.3, 0.95)),
    }
    return float(rng.uniform(1.0, 8.0)) * clearance / speed, parameters


@pytest.mark.parametrize(("seed", "count"), [(3, 12), pytest.param(4, 300, marks=pytest.mark.long)])
def test_no_sample_of_a_journal_is_beyond_its_extremes(seed: int, count: int) -> None:
    rng = np.random.default_rng(seed)
    for i in range(count):
        duration, parameters = random_journal(rng)
        check("bouncing-journal", duration, parameters, **ACCURACIES[i % len(ACCURACIES)])


def test_a_start_at_the_centre_has_no_extreme_of_rounding() -> None:
    # the pin rests at the centre of its bearing but for 1e-17 m, which it passes in the first step
    parameters = {"clearance": 0.00317, "bearing_radius": 0.0059, "speed": 599.0}
    parameters |= {"dynamic_velocity": 5.3e-4, "static_velocity": 2.7e-4}
    found = run("slider-crank", 1.5e-4, parameters=parameters, output_step=1.5e-7)
    samples, peak = found.samples["P.slip_velocity"], found.peaks["P.slip_velocity"]
    slack = CLOSE * np.ptp(samples)
    assert samples.min() - slack <= peak.minimum
    assert peak.maximum <= samples.max() + slack


def test_steps_that_swing_in_turn_are_looked_into() -> None:
    # every other step is longer, and swings five times as much: friction holds a bearing
    parameters = {"clearance_A": 0.00171042972834, "clearance_B": 0.000160960149567}
    parameters |= {"bearing_radius": 0.03052885187242814, "stiffness": 1422787700.06}
    parameters |= {"speed": 3.02042690556, "speed_crank4": 3.02042690556, "gravity_x": 9.81}
    parameters |= {"restitution": 0.628118714294, "friction": 0.179293385843}
    parameters |= {"dynamic_velocity": 0.00116670411727, "static_velocity": 0.001050033705543}
    check("seven-bar-press", 0.0585, parameters, tolerance=1.11542e-05)


def test_steps_that_begin_to_swing_as_they_grow_are_looked_into() -> None:
    # friction stops the slip of a pendulum's pin: the first step that swings shows nothing of it,
    # for its ends differ by more; the eleventh, three times as long, slips by 4e-6 m/s more inside
    contact = {"law": "lankarani-nikravesh", "stiffness": 32332595.1, "restitution": 0.24853}
    friction = {"law": "modified-coulomb", "coefficient": 0.08554}
    friction |= {"dynamic_velocity": 6.21375113575e-05, "static_velocity": 6.21375113575e-06}
    play = {"radial_clearance": 0.00342818614877, "bearing_radius": 0.02830531002063152}
    joint = {"type": "revolute", "bearing": "ground.O", "journal": "rod.a"}
    points = {"a": [-0.172755127044, 0.0]}
    scene = {
        "name": "loose-pendulum",
        "gravity": [0.0, -9.81],
        "ground": {"points": {"O": [0.0, 0.0]}},
        "bodies": {"rod": {"mass": 6.42754527794, "inertia": 0.0483115130746851, "points": points}},
        "joints": {"O": joint | {"clearance": play | {"contact": contact, "friction": friction}}},
        "start": {
            "angles": {"rod": 0.0426366214398},
            "angular_velocities": {"rod": -12.0173227095},
        },
    }
    check(scene, 0.0196, {}, method="tsitouras", tolerance=2.64614e-07)


def test_what_rises_for_an_instant_behind_a_step_end_is_seen() -> None:
    # a journal falls on: with fixed steps its contact begins at a step's end, and 0.0004 steps
    # later its weight has lost against the wall
    step, speed, gravity, clearance = 1e-4, 0.2, 9.81, 1e-3
    fall = 2.999 * step
    parameters = {"clearance": clearance, "velocity_y": -speed, "gravity_y": -gravity}
    parameters |= {"position_y": speed * fall + 0.5 * gravity * fall**2 - clearance}
    parameters |= {"stiffness": 2e11, "restitution": 0.5, "friction": 0.0}
    check("bouncing-journal", 4.0 * step, parameters, method="rk4", step=step)


@pytest.mark.parametrize("accuracy", ACCURACIES[:2])
def test_no_sample_of_the_press_is_beyond_its_extremes(accuracy: dict[str, Any]) -> None:
    check("seven-bar-press", 0.04, {"friction": 0.1}, **accuracy)


def loose_rotor() -> dict[str, Any]:
    """Return a disc with play on a pin that a driver swings about: it flies from wall to wall."""
    rise, fall = 0.03, 0.05  # s
    swing = {
        "type": "piecewise-polynomial",
        "knots": [0.0, rise, rise + fall],
        "coefficients": [
            [0, 0, 0, 10 / rise**3, -15 / rise**4, 6 / rise**5],
            [1, 0, 0, -10 / fall**3, 15 / fall**4, -6 / fall**5],
        ],
        "outside": "periodic",
    }
    clearance = {
        "radial_clearance": 6.01e-4,
        "bearing_radius": 0.0272,
        "bearing_width": 0.0163,
        "contact": {
            "law": "stiffness-and-dissipation",
            "stiffness": {"law": "esdu-78035", "youngs_modulus": 2.065e8, "poisson_ratio": 0.134},
            "dissipation": {"law": "hu-guo", "restitution": 0.79, "impact_rate_floor": 1e-4},
        },
        "friction": {
            "law": "brown-mcphee",
            "static_coefficient": 0.813,
            "kinetic_coefficient": 0.777,
            "transition_velocity": 1.39e-3,
        },
    }
    return {
        "name": "loose-rotor",
        "gravity": [0.0, -9.81],
        "ground": {"points": {"O": [0.0, 0.0]}},
        "bodies": {
            "arm": {
                "mass": 1.0,
                "inertia": 0.01,
                "points": {"O": [0, 0], "C": [-0.01316, -0.01452]},
            },
            "rotor": {"mass": 0.68, "inertia": 1.615e-3, "points": {"J": [-2.85e-3, 0.0]}},
        },
        "joints": {
            "main": {"type": "revolute", "bearing": "ground.O", "journal": "arm.O"},
            "play": {
                "type": "revolute",
                "bearing": "rotor.J",
                "journal": "arm.C",
                "clearance": clearance,
            },
        },
        "drivers": {"motor": {"joint": "main", "motion": swing}},
        "forces": {
            "spring": {
                "type": "torsion-spring",
                "first": "ground.O",
                "second": "rotor.J",
                "stiffness": 0.362,
                "damping": 0.001,
                "free_angle": -0.137,
            }
        },
        "start": {"joints": {"play": {"eccentricity": [-1.297e-4, 4.002e-4]}}},
    }


@pytest.mark.parametrize("tolerance", [1e-6, 1e-7, 1e-8])
@pytest.mark.parametrize("method", ["tsitouras", "dormand-prince-853"])
def test_a_slip_that_turns_twice_in_two_steps_of_a_flight(method: str, tolerance: float) -> None:
    check(loose_rotor(), 0.045, {}, method=method, tolerance=tolerance)


@pytest.mark.parametrize(
    "flight",
    [
        (2.8160402e-3, 3.851917121e-4, -6.803001118e-4, -0.1638888014, 0.3015500236, -0.24393686),
        (2.8427459e-3, -5.148300482e-4, 4.059786830e-4, 0.2177916926, -0.1591580342, -131.459667),
        (2.9081821e-3, 7.642387844e-4, 2.150020983e-4, -0.3155515532, -0.0760952813, -10.0938942),
    ],
)
def test_a_slip_that_turns_as_its_normal_whips_round_and_once_more(
    flight: tuple[float, ...],
) -> None:
    """Gravity bends a fall past the centre: rates at both ends of the step have one sign."""
    names = ("position_x", "position_y", "velocity_x", "velocity_y", "spin")
    check("bouncing-journal", flight[0], dict(zip(names, flight[1:], strict=True)))
