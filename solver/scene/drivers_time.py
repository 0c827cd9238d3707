"""Time in which the drivers of a scene show their motion, before anything is computed."""

import math
from typing import NamedTuple

import numpy as np

from jointplay.solver.laws.function import Function
from jointplay.solver.quantities.equal_ratios import equal_ratios
from jointplay.solver.scene.clocks import turns
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.drivers import MovingDriver
from jointplay.solver.scene.least_common_period import SLOWEST, period_of

LOOKED_AT = equal_ratios(1e-10, 1e10, 2001)
"""Instants at which a motion that never repeats is looked at, s: a decade beyond the lengths of a
ramp that a document may give, 1e-9 s to 1e9 s."""
RESTING = 1e-6
"""Share of its whole motion that a driver at rest may still move."""


class DriversTime(NamedTuple):
    """The time in which all drivers show their motion, s, and whether all are back then.

    `quickest` is the time of the one that is first through, s.
    """

    seconds: float
    repeats: bool
    quickest: float


def drivers_time(scene: Scene, length: float) -> DriversTime | None:
    """Return how long the drivers take; None where nothing is driven.

    That is their common period; where there is none, the time of the slowest: its own turn or
    period, else until it has turned once, or gone a `length` (m) as the shortest link is, or come
    to rest.
    """
    periods, others = [], []
    for driver in scene.drivers.values():
        turning = turns(scene, driver)
        far = 2.0 * math.pi if turning else length
        if isinstance(driver, MovingDriver):
            period = driver.motion.period
            if math.isinf(period):
                others.append(_until(driver.motion, far))
            elif period > 0.0:
                periods.append(period)
        elif abs(driver.clock_rate) > SLOWEST:
            (periods if turning else others).append(far / abs(float(driver.clock_rate)))
    if not periods and not others:
        return None
    own = [*periods, *others]
    common = None if others else period_of([2.0 * math.pi / one for one in periods]).seconds
    return DriversTime(common or max(own), common is not None, min(own))


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
