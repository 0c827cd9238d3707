"""Time in which the drivers of a scene show their motion, before anything is computed."""

import math
from typing import NamedTuple

import numpy as np

from jointplay.solver.laws.function import Function
from jointplay.solver.scene.clocks import turns
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.drivers import MovingDriver
from jointplay.solver.scene.periods import SLOWEST

MOST_TURNS = 20.0
"""Times of the quickest driver after which a slower one is not waited for."""
LOOKED_AT = np.geomspace(1e-4, 1e4, 801)
"""Instants at which a motion that never repeats is looked at, s."""
RESTING = 1e-6
"""Share of its whole motion that a driver at rest may still move."""


class DriversTime(NamedTuple):
    """The time in which the slowest driver shows its motion, s; whether all are back then."""

    seconds: float
    repeats: bool


def drivers_time(scene: Scene, length: float) -> DriversTime | None:
    """Return how long the drivers take; None where nothing is driven.

    That is one turn or period, else until the driver has turned once, or gone a `length` (m) as
    the shortest link is, or come to rest.
    """
    found = []
    for driver in scene.drivers.values():
        turning = turns(scene, driver)
        far = 2.0 * math.pi if turning else length
        if isinstance(driver, MovingDriver):
            period = driver.motion.period
            if math.isinf(period):
                found.append(DriversTime(_until(driver.motion, far), repeats=False))
            elif period > 0.0:
                found.append(DriversTime(period, repeats=True))
        elif abs(driver.clock_rate) > SLOWEST:
            found.append(DriversTime(far / abs(float(driver.clock_rate)), turning))
    if not found:
        return None
    slowest, latest = max(one.seconds for one in found), MOST_TURNS * min(found).seconds
    return DriversTime(
        min(slowest, latest), slowest <= latest and all(one.repeats for one in found)
    )


def _until(motion: Function, far: float) -> float:
    """Return when a motion has gone so far, or where it rests or ends if it never does."""
    with np.errstate(all="ignore"):
        values = np.broadcast_to(motion.at(LOOKED_AT).value, LOOKED_AT.shape)
    times, values = LOOKED_AT[np.isfinite(values)], values[np.isfinite(values)]
    moved = np.abs(values - motion.at(0.0).value)
    if not len(times) or not np.isfinite(moved).all():
        return float(LOOKED_AT[-1])
    reached = moved >= far
    if reached.any():
        return float(times[reached.argmax()])
    left = np.abs(values - values[-1]) > RESTING * moved.max()
    last = len(times) - 1 - int(left[::-1].argmax()) if left.any() else 0
    return float(times[min(last + 1, len(times) - 1)])
