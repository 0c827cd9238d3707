"""Clocks of a scene: what drivers, and forces that change in time, are functions of."""

import math
from dataclasses import dataclass

from jointplay.solver.laws.force.varying import Varying
from jointplay.solver.laws.function import Function
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.drivers import Driver, MovingDriver


@dataclass(frozen=True)
class Clock:
    """A clock: its reading at the start, its gain a second, and after how much it may begin anew.

    `turn` is 2 pi of an angle, the period of a function; 0: it goes on for ever.
    """

    start: float
    rate: float
    turn: float


def turns(scene: Scene, driver: Driver) -> bool:
    """Return whether a driver prescribes an angle; else it is a displacement."""
    return driver.joint is None or scene.joints[driver.joint].freedom == "turn"


def timed(scene: Scene) -> dict[str, Varying]:
    """Return the force elements that vary with time."""
    return {
        name: element
        for name, element in scene.forces.items()
        if isinstance(element, Varying)
        and element.course is not None
        and (over := element.follows()) is not None
        and over.quantity == "time"
    }


def moved_in_time(scene: Scene) -> str:
    """Return the name of a driver, or of a force, that moves a scene as a function of time.

    Empty: there is none; the scene is autonomous.
    """
    for name, driver in scene.drivers.items():
        if isinstance(driver, MovingDriver):
            moves = driver.motion.period > 0.0
        else:
            moves = driver.clock_rate != 0.0
        if moves:
            return name
    for name, element in timed(scene).items():
        if element.course is not None and element.course.period > 0.0:
            return name
    return ""


def clocks(scene: Scene) -> dict[str, Clock]:
    """Return the clocks by name of driver, then by name of what varies with time."""
    found = {}
    for name, driver in scene.drivers.items():
        turn = 2.0 * math.pi if turns(scene, driver) else 0.0
        if isinstance(driver, MovingDriver):
            turn = _turn(driver.motion)
        found[name] = Clock(driver.clock_start, driver.clock_rate, turn)
    for name, element in timed(scene).items():
        assert element.course is not None  # noqa: S101  (narrows the type)
        found[name] = Clock(0.0, 1.0, _turn(element.course))
    return found


def _turn(function: Function) -> float:
    return function.period if math.isfinite(function.period) else 0.0
