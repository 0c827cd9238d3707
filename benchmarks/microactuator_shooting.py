"""The microactuator of COCO's demo `stickslip` by shooting, with events; see `microactuator`."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import root

from jointplay.records.arrays import Floats

DAMPING, FRICTION, FREQUENCY, RESTITUTION = 0.04, 3.17, 0.92, 0.8
"""c, n, w and e of the demo; all its numbers are made dimensionless."""
BOX, WALL = 5.0, 0.5
"""kg and m; the mass is 1 kg and its spring 1 N/m."""
PERIOD = math.pi / FREQUENCY
SHARP: dict[str, Any] = {"method": "DOP853", "rtol": 1e-13, "atol": 1e-14}
GUESS = np.array([-0.1, 0.18])
"""Time of an impact, s, and speed before it, m/s."""


def stuck(excited: float) -> Callable[[float, Any], list[float]]:
    """Return the slope of q and its rate while the box sticks, at V."""

    def slope(t: float, y: Any) -> list[float]:
        return [y[1], _force(excited, t, y[0], y[1])]

    return slope


def known_grazing() -> float:
    """Return V at which the motion without impacts grazes."""

    def away(unknown: Any) -> Floats:
        at, excited = unknown
        found = solve_ivp(stuck(excited), (at, at + PERIOD), [WALL, 0.0], **SHARP)
        return np.asarray(found.y[:, -1]) - [WALL, 0.0]

    return float(root(away, [0.0, 0.57], tol=1e-13).x[1])


def known_stuck(excited: float) -> Floats:
    """Return q and its rate at phase 0 of the stable motion without impacts."""

    def away(state: Floats) -> Floats:
        found = solve_ivp(stuck(excited), (0.0, PERIOD), state, **SHARP)
        return np.asarray(found.y[:, -1]) - state

    return np.asarray(root(away, [0.48, -0.005], tol=1e-12).x)


def known_orbit(excited: float) -> tuple[Floats, Floats]:
    """Return q and its rate at phase 0 of the orbit with one impact, and both multipliers."""

    def away(impact: Floats) -> Floats:
        return _next(excited, impact)[0] - impact

    found = root(away, GUESS, tol=1e-12).x
    steps = 1e-5 * np.eye(2)
    columns = [_next(excited, found + h)[0] - _next(excited, found - h)[0] for h in steps]
    multipliers = np.linalg.eigvals(np.array(columns).T / 2e-5)
    assert np.isrealobj(multipliers)
    ordered = multipliers[np.argsort(-np.abs(multipliers))]
    return _next(excited, found)[1], np.asarray(ordered, np.float64)


def _force(excited: float, t: float, q: float, rate: float) -> float:
    pulled = (excited * math.sin(FREQUENCY * t) / (1.0 - q)) ** 2
    return pulled - DAMPING * rate - q


def _next(excited: float, impact: Any) -> tuple[Floats, Floats]:
    """Return the impact after one, less a period, and q and its rate at phase 0 between both."""

    def sliding(t: float, y: Any) -> list[float]:
        force = _force(excited, t, y[1], y[2])
        return [-FRICTION - force / BOX, y[2], FRICTION + force * (1.0 + 1.0 / BOX)]

    def rest(_t: float, y: Any) -> float:
        return float(y[0])

    def hit(_t: float, y: Any) -> float:
        return float(y[0]) - WALL

    rest.terminal, rest.direction = True, -1.0  # type: ignore[attr-defined]
    hit.terminal, hit.direction = True, 1.0  # type: ignore[attr-defined]
    at, speed = impact
    begin = [(1.0 + RESTITUTION) / (1.0 + BOX) * speed, WALL, -RESTITUTION * speed]
    slid = solve_ivp(sliding, (at, at + PERIOD), begin, events=rest, **SHARP)
    slope, start = stuck(excited), (slid.t[-1], slid.y[1:, -1])
    between = solve_ivp(slope, (start[0], 0.0), start[1], **SHARP).y[:, -1]
    struck = solve_ivp(slope, (0.0, 2.0 * PERIOD), between, events=hit, **SHARP)
    return np.array([struck.t[-1] - PERIOD, struck.y[1, -1]]), between
