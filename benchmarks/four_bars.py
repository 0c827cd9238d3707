"""Rows of four-bars: loops of ideal joints, as many as wanted."""

import math
from typing import Any


def four_bars(count: int) -> dict[str, Any]:
    """Return four-bars side by side, upright, every link 1 m and 1 kg.

    Source: benchmark A02 of the IFToMM library of computational benchmark problems.
    """
    rod = {"mass": 1.0, "inertia": 1.0 / 12.0, "points": {"a": [-0.5, 0.0], "b": [0.5, 0.0]}}
    cranks, couplers = [f"B{i}" for i in range(count + 1)], [f"C{i}" for i in range(count)]
    joints = {f"A{i}": (f"ground.A{i}", f"{name}.a") for i, name in enumerate(cranks)}
    joints |= {f"L{i}": (f"{cranks[i]}.b", f"{name}.a") for i, name in enumerate(couplers)}
    joints |= {f"R{i}": (f"{name}.b", f"{cranks[i + 1]}.b") for i, name in enumerate(couplers)}
    return {
        "name": "four-bars",
        "gravity": [0.0, -9.81],
        "ground": {"points": {f"A{i}": [float(i), 0.0] for i in range(count + 1)}},
        "bodies": dict.fromkeys([*cranks, *couplers], rod),
        "joints": {
            name: {"type": "revolute", "bearing": bearing, "journal": journal}
            for name, (bearing, journal) in joints.items()
        },
        "start": {"angles": dict.fromkeys(cranks, math.pi / 2) | dict.fromkeys(couplers, 0.0)},
    }
