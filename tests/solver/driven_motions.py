"""Mechanisms whose drivers follow functions of time: drawn instants, and pendulums they carry."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from jointplay.solver.laws.function import FUNCTIONS, Function
from jointplay.solver.scene.document import Scene
from tests.solver.random_mechanisms import numbers
from tests.solver.readable_mechanics import Instant

MASS, INERTIA, LENGTH, GRAVITY = 1.5, 0.02, 0.3, 9.81
"""Pendulum: kg, kg m^2 about its centre of mass, m from the pin to that; m/s^2."""


rates = numbers(-5.0, 5.0)


def function(document: dict[str, Any]) -> Function:
    """Return the function of a document."""
    return FUNCTIONS[document["type"]].model_validate(document)


@st.composite
def moved(draw: st.DrawFn, instants: st.SearchStrategy[Instant]) -> Instant:
    """Draw an instant whose drivers are where and as fast as drawn, and accelerate."""
    instant = draw(instants)
    document = instant.scene.model_dump()
    for name, driver in document["drivers"].items():
        motion = {"type": "polynomial", "coefficients": [0.0, driver.pop("speed"), draw(rates)]}
        driver |= {"position": instant.driven[name], "motion": motion}
    scene, clocks = Scene.model_validate(document), dict.fromkeys(instant.driven, 0.0)
    return replace(instant, scene=scene, driven=clocks)


def carried(motion: dict[str, Any], kind: str = "revolute") -> dict[str, Any]:
    """Return a scene: a carrier moves as prescribed, a pendulum hangs at its point P.

    A revolute carrier is a crank of 0.3 m; a prismatic one slides along x.
    """
    pin = {"type": "revolute", "bearing": "ground.O", "journal": "carrier.O"}
    slide = {"type": "prismatic", "guide": "ground.O", "slider": "carrier.O", "axis": [1.0, 0.0]}
    return {
        "name": "carried-pendulum",
        "gravity": [0.0, -GRAVITY],
        "ground": {"points": {"O": [0.0, 0.0]}},
        "bodies": {
            "carrier": {
                "mass": 1.0,
                "inertia": 0.1,
                "points": {"O": [-0.1, 0.0], "P": [0.2, 0.0]},
            },
            "bob": {"mass": MASS, "inertia": INERTIA, "points": {"P": [-LENGTH, 0.0]}},
        },
        "joints": {
            "J": pin if kind == "revolute" else slide,
            "P": {"type": "revolute", "bearing": "carrier.P", "journal": "bob.P"},
        },
        "drivers": {"motor": {"joint": "J", "motion": motion}},
        "start": {"angles": {"bob": -1.0}},
    }


def independent(
    motion: dict[str, Any],
    kind: str,
    time: np.ndarray,
    start: tuple[float, float],
    kinks: Sequence[float] = (),
) -> np.ndarray:
    """Return the bob's angle, rad, at times from its equation of motion, by SciPy.

    `start` is angle (rad) and speed (rad/s); at `kinks` (s) the integration begins anew.
    """
    follow = function(motion)

    def slope(t: float, state: np.ndarray) -> list[float]:
        angle, rate, acceleration = follow.at(t)
        pin = np.array([acceleration, 0.0])
        if kind == "revolute":
            along = np.array([np.cos(angle), np.sin(angle)])
            across = np.array([-along[1], along[0]])
            pin = 0.3 * (acceleration * across - rate * rate * along)
        pull = np.array([0.0, -GRAVITY]) - pin
        arm = LENGTH * np.array([np.cos(state[0]), np.sin(state[0])])
        moment = MASS * (arm[0] * pull[1] - arm[1] * pull[0])
        return [state[1], moment / (INERTIA + MASS * LENGTH**2)]

    found, state, now = [start[0]], np.array(start), 0.0
    for end in time[1:]:
        stops = [*(t for t in kinks if now + 1e-12 < t < end - 1e-12), end]
        for stop in stops:
            way = solve_ivp(slope, (now, stop), state, method="DOP853", rtol=1e-12, atol=1e-13)
            state, now = way.y[:, -1], stop
        found.append(float(state[0]))
    return np.array(found)
