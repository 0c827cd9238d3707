"""Motions with a closed form: pendulum, slider-crank."""

import math

import numpy as np
import pytest
from scipy.special import ellipk

from tests.solver.completed_runs import run

HALF_LENGTH = 0.5
STIFFNESS = 1.0 * 9.81 * HALF_LENGTH / (1.0 / 12.0 + HALF_LENGTH**2)
"""m g l / I about the pivot, 1/s²."""


@pytest.mark.parametrize("amplitude", [0.01, 1.0, math.pi / 2, 3.0])
@pytest.mark.parametrize("formulation", ["reduced", "lagrange"])
def test_the_pendulum_swings_with_the_period_of_the_elliptic_integral(
    amplitude: float, formulation: str
) -> None:
    period = 4.0 / math.sqrt(STIFFNESS) * ellipk(math.sin(amplitude / 2.0) ** 2)
    found = run(
        "pendulum",
        3.0 * period,
        parameters={"angle": -math.pi / 2 + amplitude},
        tolerance=1e-11,
        output_step=period / 2.0,
        formulation=formulation,
    )
    swing = found["angle"] + math.pi / 2
    # every half period the other end; the angle is flat there, the speed shows the phase
    np.testing.assert_allclose(
        swing, amplitude * np.array([1, -1, 1, -1, 1, -1, 1]), rtol=0, atol=1e-8
    )
    np.testing.assert_allclose(found["angular_velocity"], 0.0, atol=1e-8 * STIFFNESS)


def test_the_pendulum_keeps_its_energy() -> None:
    found = run("pendulum", 10.0, tolerance=1e-11)
    total = found["energy.kinetic"] + found["energy.potential"]
    # IFToMM A01: horizontal release, 10 s, no drift
    assert np.abs(total - total[0]).max() < 1e-8
    assert abs(found.statistics["energy"]["residual"]) < 1e-8
    assert found.admission.sections == 0
    assert found.admission.period is None
    assert "No driver turns" in found.admission.section_note


CRANK, ROD = 0.05, 0.12


def closed_form(t: np.ndarray, speed: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Position, velocity, acceleration of the slider of a slider-crank."""
    angle = speed * t
    s, c = CRANK * np.sin(angle), CRANK * np.cos(angle)
    lever = np.sqrt(ROD**2 - s**2)
    lever_rate = -s * c * speed / lever
    x = c + lever
    v = -s * speed + lever_rate
    a = -c * speed**2 - (c**2 - s**2) * speed**2 / lever - lever_rate**2 / lever
    return x, v, a


@pytest.mark.parametrize("speed", [523.5987755982989, -20.0])
def test_the_ideal_slider_crank_moves_in_closed_form(speed: float) -> None:
    period = 2.0 * math.pi / abs(speed)
    found = run(
        "slider-crank",
        2.3 * period,
        parameters={"clearance": 0.0, "speed": speed},
        output_step=period / 97.0,
        channels=["slider.x", "slider.vx", "slider.ax", "crank.theta"],
    )
    x, v, a = closed_form(found.time, speed)
    # rounding of the local time, 1e-16 of a period, and of positions of 0.2 m
    np.testing.assert_allclose(found["slider.x"], x, rtol=0, atol=2e-15)
    np.testing.assert_allclose(found["slider.vx"], v, rtol=0, atol=2e-14 * abs(speed))
    np.testing.assert_allclose(found["slider.ax"], a, rtol=0, atol=1e-13 * speed**2)
    np.testing.assert_allclose(found["crank.theta"], speed * found.time, rtol=1e-14, atol=1e-15)
    # the largest acceleration is at the dead centre, exactly -(r + r²/l) w²
    peak = found.peaks["slider.ax"]
    assert peak.minimum == pytest.approx(-(CRANK + CRANK**2 / ROD) * speed**2, rel=1e-12)
    assert found.peaks["slider.x"].maximum == pytest.approx(CRANK + ROD, rel=1e-14)
    assert found.peaks["slider.x"].minimum == pytest.approx(ROD - CRANK, rel=1e-13)


def test_the_ideal_slider_crank_needs_the_force_that_accelerates_its_slider() -> None:
    names = ["Q.force_x", "slider.ax", "energy.kinetic", "motor.power"]
    found = run("slider-crank", 0.01, parameters={"clearance": 0.0}, channels=names)
    np.testing.assert_allclose(
        found["Q.force_x"], -0.14 * found["slider.ax"], rtol=0, atol=1e-9
    )  # the rod on the slider, as the slider feels it: Q's force acts on the rod
    energy = found["energy.kinetic"]
    power = np.gradient(energy, found.time, edge_order=2)[1:-1]
    # central differences of a motion with the crank's third harmonic: (3 w h)² / 6 of 2 kW
    step, speed = found.time[1], 523.6
    bound = (3.0 * speed * step) ** 2 * np.abs(found["motor.power"]).max()
    np.testing.assert_allclose(found["motor.power"][1:-1], power, rtol=0, atol=bound)


def test_a_vanishing_clearance_approaches_the_ideal_mechanism_in_proportion() -> None:
    speed, deviations = 20.0, []
    for clearance in (4e-4, 1e-4, 2.5e-5):
        found = run(
            "slider-crank",
            2.0 * math.pi / speed,
            parameters={"clearance": clearance, "stiffness": 1e12, "speed": speed},
            tolerance=1e-8,
            channels=["slider.x", "P.penetration"],
        )
        exact = closed_form(found.time, speed)[0]
        deviation = float(np.abs(found["slider.x"] - exact).max())
        # the pin is off by the clearance and the penetration; a rod at its steepest turns that
        # into 1 / cos of its angle times as much at the slider
        steepest = 1.0 / math.sqrt(1.0 - (CRANK / ROD) ** 2)
        eccentricity = clearance + found.peaks["P.penetration"].maximum
        assert deviation <= steepest * eccentricity * (1.0 + 1e-2)  # to first order in it
        deviations.append(deviation / clearance)
    # in proportion: the journal rests on its bearing's wall at least once in each
    assert min(deviations) > 0.9
    assert max(deviations) < 1.5
