"""Scales of time that a scene's drivers and forces give: how soon what moves it turns or bends."""

import math

from jointplay.solver.laws.force import ForceElement
from jointplay.solver.laws.force.varying import Varying
from jointplay.solver.quantities.scalars import Scalar, greatest, sqrt
from jointplay.solver.scene.clocks import turns
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.drivers import Driver, MovingDriver
from jointplay.solver.scene.least_common_period import SLOWEST


def characteristic_time(scene: Scene, length: float) -> Scalar:
    """Return a time scale, s: the shortest driver period, else that of a pendulum, else 1 s."""
    speeds = [speed for driver in scene.drivers.values() for speed in _speeds(scene, driver)]
    speeds += [speed for element in scene.forces.values() for speed in _paces(scene, element)]
    turning = [speed for speed in speeds if speed >= SLOWEST]
    if turning:
        return 2.0 * math.pi / greatest(turning)
    gravity = sqrt(sum(part * part for part in scene.gravity))
    return 2.0 * math.pi * sqrt(length / gravity) if gravity > 0.0 else 1.0


def quickest_driver(scene: Scene, length: float) -> float:
    """Return the time in which the fastest driver turns, bends, or moves by 2 pi lengths, s.

    Infinite where all drivers stand.
    """
    paces = []
    for driver in scene.drivers.values():
        lever = 1.0 if turns(scene, driver) else length
        straight = not isinstance(driver, MovingDriver)
        paces += [speed / (lever if straight else 1.0) for speed in _speeds(scene, driver)]
        if isinstance(driver, MovingDriver) and math.isinf(driver.motion.bend):
            paces.append(driver.motion.speed_within(lever) / lever)
    fastest = max(paces, default=0.0)
    return 2.0 * math.pi / fastest if fastest else math.inf


def _speeds(scene: Scene, driver: Driver) -> list[float]:
    """Return what gives a driver's motion a scale of time, rad/s.

    Of an angle that is a polynomial of time it is the speed after the first radian.
    """
    if not isinstance(driver, MovingDriver):
        return [abs(driver.clock_rate)]
    found = [2.0 * math.pi / driver.motion.bend]
    if turns(scene, driver):
        found.append(driver.motion.speed_within(1.0))
    return found


def _paces(scene: Scene, element: ForceElement) -> list[float]:
    """Return what gives a force element a scale of time, rad/s."""
    over = element.follows()
    if not isinstance(element, Varying) or element.course is None or over is None:
        return [element.fastest]
    bends = 2.0 * math.pi / element.course.bend
    if over.quantity == "time":
        return [bends]
    if over.quantity == "driver" and over.driver is not None and not over.rate:
        driver = scene.drivers[over.driver]
        if not isinstance(driver, MovingDriver):
            return [bends * abs(driver.clock_rate)]
    return []


def driven_speed(scene: Scene, lever: float, until: float) -> float:
    """Return the sum of the drivers' angular speeds, rad/s.

    A motion counts with the least r whose powers exceed its derivatives (see
    `kernels.emit.enclosure`), over 0..`until` s, in rad or in `lever`, m.
    """
    total = 0.0
    for driver in scene.drivers.values():
        turning = turns(scene, driver)
        if isinstance(driver, MovingDriver):
            total += driver.motion.quickness(until, 1.0 if turning else lever)
        elif turning:
            total += abs(driver.clock_rate)
    return total


def driven_travel(scene: Scene, unit: float, until: float) -> float:
    """Return how far functions move driven sliders over 0..`until` s, m, as seen in `unit`, s.

    The least length L with |x^(k)| <= L (2 pi / unit)^k for each derivative of each of their
    motions; of a sinusoidal motion with that period its amplitude. 0: there is none.
    """
    ways = [
        bound * math.prod([unit / (2.0 * math.pi)] * order)
        for driver in scene.drivers.values()
        if isinstance(driver, MovingDriver) and not turns(scene, driver)
        for order, bound in enumerate(driver.motion.largest(until), start=1)
    ]
    return max(ways, default=0.0)
