"""Tangent vectors of a run whose drive and force have knots, against their own equation."""

from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from jointplay.solver.scene.document import Scene
from tests.solver.driven_motions import function
from tests.solver.kernels.tangent_runs import bundle_of, growth, problem
from tests.solver.knotted_scene import FULL_RATE, JERKED, WELLS

LENGTH, MASS, INERTIA, GRAVITY = 0.3, 1.0, 0.05, 9.81
DURATION = 0.6


def scene() -> Scene:
    """Return a pendulum on a driven carrier under forces of its place and while that rises."""
    force = {"type": "force", "magnitude": 1.0, "direction": [1.0, 0.0]}
    force |= {"first": "ground.O", "second": "bob.C", "over": {"quantity": "x"}}
    points = {"points": {"O": [0.0, 0.0]}}
    return Scene.model_validate(
        {
            "name": "carried",
            "gravity": [0.0, -GRAVITY],
            "ground": points,
            "bodies": {
                "carrier": {"mass": 1.0, "inertia": 1.0} | points,
                "bob": {
                    "mass": MASS,
                    "inertia": INERTIA,
                    "points": {"P": [-LENGTH, 0.0], "C": [0.0, 0.0]},
                },
            },
            "joints": {
                "base": {
                    "type": "prismatic",
                    "guide": "ground.O",
                    "slider": "carrier.O",
                    "axis": [1.0, 0.0],
                },
                "pin": {"type": "revolute", "bearing": "carrier.O", "journal": "bob.P"},
            },
            "drivers": {"motor": {"joint": "base", "motion": JERKED}},
            "forces": {
                "wells": force | {"course": WELLS},
                "kick": force | {"only": "rising", "full_rate": FULL_RATE},
            },
            "start": {"angles": {"bob": 0.4}, "angular_velocities": {"bob": -3.0}},
        }
    )


def acceleration_and_rates(time: float, angle: float, speed: float) -> tuple[float, float, float]:
    """Return the pendulum's angular acceleration and its derivatives by angle and speed."""
    carrier, wells = function(JERKED).at(time), function(WELLS)
    sine, cosine = np.sin(angle), np.cos(angle)
    held = wells.at(carrier.value + LENGTH * cosine)
    rate = carrier.slope - LENGTH * sine * speed
    u = min(max(rate / FULL_RATE, 0.0), 1.0)
    push = held.value + u * u * (3.0 - 2.0 * u) - MASS * carrier.curvature
    by_place, by_rate = held.slope, 6.0 * u * (1.0 - u) / FULL_RATE
    turned = -sine * push - MASS * GRAVITY * cosine
    by_angle = -cosine * push + MASS * GRAVITY * sine
    by_angle += sine * LENGTH * (by_place * sine + by_rate * cosine * speed)
    share = LENGTH / (INERTIA + MASS * LENGTH**2)
    return share * turned, share * by_angle, share * LENGTH * sine * sine * by_rate


def slopes(time: float, state: Any) -> list[float]:
    angle, speed, aside, drifting = state
    turned, by_angle, by_speed = acceleration_and_rates(time, angle, speed)
    return [speed, turned, drifting, by_angle * aside + by_speed * drifting]


def test_a_tangent_passes_knots_of_a_drive_and_of_a_force_as_its_own_equation_says() -> None:
    bundle = bundle_of([problem(scene(), DURATION, 1e-10)])
    lane = bundle.lane(0)
    state = np.concatenate([lane["y"], lane["tangent"]])
    bundle.advance(10**8)
    grown = np.exp(growth(bundle)[:, 1].sum())
    found = np.concatenate([lane["y"], grown * lane["tangent"]])
    for begun, ended in zip(JERKED["knots"], [*JERKED["knots"][1:], DURATION], strict=True):
        span = (begun, np.nextafter(ended, begun))
        way = solve_ivp(slopes, span, state, "DOP853", rtol=1e-11, atol=1e-13, max_step=1e-3)
        state = way.y[:, -1]
    # SciPy passes knots of places inside its steps: 2e-10 of the motion, 7e-6 of the tangent; the
    # tangent's own half steps, of order three and 4 ms, are worth 2e-6
    np.testing.assert_allclose(found[:2], state[:2], rtol=1e-8)
    np.testing.assert_allclose(found[2:], state[2:], rtol=3e-5)
    assert abs(np.log(grown)) > 0.3  # else an unchanged tangent would do, nearly
