"""Sizes of channels, by their units: what rounding is measured by where a value itself is zero."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


def sizes(scene: Mapping[str, Any], units: Sequence[str], values: Floats) -> Floats:
    """Return the size of each channel, (channels,), from values, (instants, channels).

    The largest value of any channel of the unit, but no less than what the accelerations in the
    scene make of masses and lengths: a multiplier that should vanish is rounded at that.
    """
    largest = np.abs(values).max(axis=0)
    of_unit = {unit: float(largest[np.array(units) == unit].max()) for unit in set(units)}
    arms = [
        math.hypot(*point) for body in scene["bodies"].values() for point in body["points"].values()
    ]
    length = max([of_unit.get("m", 0.0), *arms])
    mass = max(body["mass"] for body in scene["bodies"].values())
    spin = of_unit.get("rad/s", 0.0)
    speed = max(of_unit.get("m/s", 0.0), length * spin)
    turning = length * max(spin**2, of_unit.get("rad/s^2", 0.0))
    acceleration = max(of_unit.get("m/s^2", 0.0), turning, math.hypot(*scene["gravity"]))
    least = {
        "m": length,
        "m/s": speed,
        "m/s^2": acceleration,
        "rad": 1.0,
        "rad/s": speed / length,
        "rad/s^2": acceleration / length,
        "N": mass * acceleration,
        "N m": mass * acceleration * length,
        "W": mass * acceleration * speed,
        "J": mass * max(speed**2, math.hypot(*scene["gravity"]) * length),
    }
    return np.array([max(of_unit[unit], least.get(unit, 0.0)) for unit in units])
