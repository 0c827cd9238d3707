"""Clocks of a scene: what drivers, and forces that change in time, are functions of."""

import math
from dataclasses import dataclass

from jointplay.solver.scene.document import MovingDriver, Scene
from jointplay.solver.scene.references import turns


@dataclass(frozen=True)
class Clock:
    """What a clock shows at the start, gains a second, and after how much it may begin anew.

    `turn` is 2 pi of an angle, the period of a function; 0: it goes on for ever.
    """

    start: float
    rate: float
    turn: float


def clocks(scene: Scene) -> dict[str, Clock]:
    """Return the clocks by name of driver, in the order of the document."""
    found = {}
    for name, driver in scene.drivers.items():
        turn = 2.0 * math.pi if turns(scene, driver.joint) else 0.0
        if isinstance(driver, MovingDriver):
            turn = driver.motion.period if math.isfinite(driver.motion.period) else 0.0
        found[name] = Clock(driver.clock_start, driver.clock_rate, turn)
    return found
