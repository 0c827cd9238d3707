"""Scenes whose loops of ideal joints move, of any number: rows of four-bars, parallel cranks."""

import math
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

GRAVITY = 9.81


def four_bars(count: int, speed: float) -> dict[str, Any]:
    """Return four-bars side by side, upright, every link 1 m and 1 kg; speed of the cranks, rad/s.

    The row of benchmark A02 of the IFToMM library.
    """
    rod = {"mass": 1.0, "inertia": 1.0 / 12.0, "points": {"a": [-0.5, 0.0], "b": [0.5, 0.0]}}
    cranks, couplers = [f"B{i}" for i in range(count + 1)], [f"C{i}" for i in range(count)]
    joints = {f"A{i}": ("ground", f"A{i}", name, "a") for i, name in enumerate(cranks)}
    joints |= {f"L{i}": (cranks[i], "b", name, "a") for i, name in enumerate(couplers)}
    joints |= {f"R{i}": (name, "b", cranks[i + 1], "b") for i, name in enumerate(couplers)}
    return {
        "name": "four-bars",
        "gravity": [0.0, -GRAVITY],
        "ground": {"points": {f"A{i}": [float(i), 0.0] for i in range(count + 1)}},
        "bodies": dict.fromkeys([*cranks, *couplers], rod),
        "joints": {
            name: {"type": "revolute", "bearing": f"{a}.{p}", "journal": f"{b}.{q}"}
            for name, (a, p, b, q) in joints.items()
        },
        "start": {
            "angles": dict.fromkeys(cranks, math.pi / 2) | dict.fromkeys(couplers, 0.0),
            "angular_velocities": dict.fromkeys(cranks, speed),
        },
    }


def four_bars_angle(count: int, speed: float, time: float) -> float:
    """Return the cranks' angle of `four_bars`: that of one pendulum, rad."""
    inertia = (count + 1) / 3.0 + count
    return _swung(((count + 1) / 2.0 + count) / inertia, math.pi / 2, speed, time)


def parallel_cranks(count: int) -> dict[str, Any]:
    """Return a plate on parallel cranks of 1 m and 1 kg; all but two of them are redundant."""
    names = [f"B{i}" for i in range(count)]
    rod = {"mass": 1.0, "inertia": 1.0 / 12.0, "points": {"a": [-0.5, 0.0], "b": [0.5, 0.0]}}
    plate = {"mass": 2.0, "inertia": 0.7, "points": {f"P{i}": [i - 1.0, 0.0] for i in range(count)}}
    joints = {f"A{i}": (f"ground.A{i}", f"{name}.a") for i, name in enumerate(names)}
    joints |= {f"P{i}": (f"{name}.b", f"plate.P{i}") for i, name in enumerate(names)}
    return {
        "name": "parallel-cranks",
        "gravity": [0.0, -GRAVITY],
        "ground": {"points": {f"A{i}": [float(i), 0.0] for i in range(count)}},
        "bodies": dict.fromkeys(names, rod) | {"plate": plate},
        "joints": {
            name: {"type": "revolute", "bearing": first, "journal": second}
            for name, (first, second) in joints.items()
        },
        "start": {
            "angles": dict.fromkeys(names, 1.0) | {"plate": 0.0},
            "angular_velocities": dict.fromkeys(names, 0.5),
        },
    }


def parallel_cranks_angle(count: int, time: float) -> float:
    """Return the cranks' angle of `parallel_cranks`, rad; the plate does not turn."""
    return _swung((count / 2.0 + 2.0) / (count / 3.0 + 2.0), 1.0, 0.5, time)


def _swung(ratio: float, angle: float, speed: float, time: float) -> float:
    """Return the angle θ after a time, where θ'' = -ratio g cos θ."""

    def slopes(_time: float, state: Any) -> list[float]:
        return [state[1], -ratio * GRAVITY * math.cos(state[0])]

    found = solve_ivp(slopes, (0.0, time), [angle, speed], "DOP853", rtol=1e-13, atol=1e-13)
    return float(np.asarray(found.y)[0, -1])
