"""Periods of a scene's drivers: what a revolution is, and whether there is one."""

import math
from typing import NamedTuple

from jointplay.solver.laws.force.varying import Varying
from jointplay.solver.laws.function.whole_turn import repeats_every_turn
from jointplay.solver.scene.clocks import timed, turns
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.drivers import MovingDriver
from jointplay.solver.scene.least_common_period import Period, period_of
from jointplay.solver.scene.once_per_scene import once_per_scene

AGREEING = 1e-6
"""Relative mismatch up to which a scene gives the period that its drivers have: six digits."""


def common_period(scene: Scene) -> Period:
    """Return the period of a scene's drivers, else the one that it gives itself, if any."""
    own = drivers_period(scene)
    if own.seconds is None and scene.period is not None:
        return Period(scene.period, own.note, given=True)
    return own


def idle_period(scene: Scene) -> str:
    """Return why the period that a scene gives has no effect; empty: it has, or there is none."""
    own = drivers_period(scene).seconds
    if scene.period is None or own is None or math.isclose(own, scene.period, rel_tol=AGREEING):
        return ""
    return (
        f"What drives the scene repeats after {own:.9g} s, which is the time between sections; a"
        f" period of {scene.period:g} s has no effect. Leave it out."
    )


@once_per_scene
def drivers_period(scene: Scene) -> Period:
    """Return the least time after which every driven angle is back; signs do not matter.

    Harmonics of amplitude zero count as others, but need not have a period in common with them.
    """
    speeds: list[float] = []
    moving: list[float] = []
    for name, driver in scene.drivers.items():
        if isinstance(driver, MovingDriver):
            if math.isinf(driver.motion.period):
                return Period(None, f"The motion of '{name}' never repeats, so there is no period.")
            if driver.motion.period > 0.0:
                speeds.append(2.0 * math.pi / driver.motion.period)
                moving += [] if driver.motion.is_constant else speeds[-1:]
        elif driver.clock_rate != 0.0:
            if not turns(scene, driver):
                return Period(None, "A driven slider never comes back, so there is no period.")
            speeds.append(abs(driver.clock_rate))
            moving += speeds[-1:]
    for name, element in timed(scene).items():
        course = element.course
        if course is None or course.period == 0.0:
            continue
        if math.isinf(course.period):
            return Period(None, f"The force '{name}' never repeats, so there is no period.")
        speeds.append(2.0 * math.pi / course.period)
        moving += [] if course.is_constant else speeds[-1:]
    found = period_of(speeds)
    return period_of(moving) if found.seconds is None and moving else found


def never_back(scene: Scene) -> str:
    """Return why a scene is not the same again after its period; empty: it is.

    A slider that is driven at a constant speed does not come back, but what it moves may.
    """
    if drivers_period(scene).seconds is not None:
        return ""
    for name, period in _moving(scene).items():
        if math.isinf(period):
            return f"'{name}' moves the mechanism in time and never repeats"
        if not _back_after(scene.period or 0.0, period):
            whole = "the scene gives no 'period' after which all that moves it is back"
            if scene.period is not None:
                whole = f"the scene's period of {scene.period:.9g} s is no multiple of that"
            return f"'{name}' repeats after {period:.9g} s, and {whole}"
    return ""


def moves_in_time(scene: Scene) -> bool:
    """Return whether something moves a scene in time, but for sliders at a constant speed."""
    return bool(_moving(scene))


class InStep(NamedTuple):
    """Comparison of an interval with the periods of what moves a scene in time."""

    back: bool
    """Whether it is a multiple of any."""
    others: int
    """Number of those of which it is none, and which have no common period with each other."""


def in_step(scene: Scene, interval: float) -> InStep:
    """Return how an interval, s, compares with the periods of what moves a scene in time.

    What never repeats, such as a start-up, says nothing: behind it, what it drives may recur.
    """
    periods = sorted({one for one in _moving(scene).values() if math.isfinite(one)})
    out = [one for one in periods if not _back_after(interval, one)]
    apart: list[float] = []
    for one in out:
        pairs = [(2.0 * math.pi / one, 2.0 * math.pi / other) for other in apart]
        if all(period_of(pair).seconds is None for pair in pairs):
            apart.append(one)
    return InStep(len(out) < len(periods), len(apart))


def _back_after(interval: float, period: float) -> bool:
    """Return whether an interval is a number of whole periods, none of them 0.

    However many they are, they may end a millionth of one period before or behind it.
    """
    times = interval / period
    return round(times) > 0 and abs(times - round(times)) <= AGREEING


def _moving(scene: Scene) -> dict[str, float]:
    """Return the periods of what moves a scene in time, s, but for sliders at a constant speed."""
    found = {}
    for name, driver in scene.drivers.items():
        if isinstance(driver, MovingDriver):
            found[name] = 0.0 if driver.motion.is_constant else driver.motion.period
        elif driver.clock_rate != 0.0 and turns(scene, driver):
            found[name] = 2.0 * math.pi / abs(driver.clock_rate)
    for name, element in timed(scene).items():
        if element.course is not None and not element.course.is_constant:
            found[name] = element.course.period
    return {name: period for name, period in found.items() if period > 0.0}


def forces_repeat(scene: Scene) -> bool:
    """Return whether forces over an angle are what they were after every turn."""
    return all(
        repeats_every_turn(element.course)
        for element in scene.forces.values()
        if isinstance(element, Varying) and element.course and element.turns_counted()
    )


def first_speed(scene: Scene) -> float:
    """Return 2 pi over the period of the first driver that has one, else the scene's; else 1."""
    for driver in scene.drivers.values():
        if isinstance(driver, MovingDriver):
            if 0.0 < driver.motion.period < math.inf:
                return 2.0 * math.pi / driver.motion.period
        elif driver.clock_rate != 0.0 and turns(scene, driver):
            return float(abs(driver.clock_rate))
    for element in timed(scene).values():
        if element.course is not None and 0.0 < element.course.period < math.inf:
            return 2.0 * math.pi / element.course.period
    return 1.0 if scene.period is None else 2.0 * math.pi / scene.period


def section_offset(scene: Scene, period: float, crank_angle: float) -> float:
    """Return the time of the first section, s: when the first driver has turned that far.

    A motion that is a function turns once in its period.
    """
    return min(crank_angle / first_speed(scene), period) if crank_angle else 0.0
