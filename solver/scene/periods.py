"""Periods of a scene's drivers: what a revolution is, and whether there is one."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from typing import NamedTuple

from jointplay.solver.laws.force import ForceElement
from jointplay.solver.laws.force.varying import Varying
from jointplay.solver.laws.function.whole_turn import repeats_every_turn
from jointplay.solver.quantities.scalars import Scalar, greatest, sqrt
from jointplay.solver.scene.clocks import timed, turns
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.drivers import Driver, MovingDriver
from jointplay.solver.scene.once_per_scene import once_per_scene

LARGEST_RATIO = 1000
"""Speeds whose ratio needs larger whole numbers than this count as incommensurate."""
SLOWEST = 1e-9
"""Speeds below, rad/s or m/s, give no time scale: a revolution takes two centuries."""
RATIO_TOLERANCE = 1e-12
"""Relative mismatch within which a ratio of speeds is taken as exact: rounding of the input."""

AGREEING = 1e-6
"""Relative mismatch up to which a scene gives the period that its drivers have: six digits."""


@dataclass(frozen=True)
class Period:
    """The least common period of the drivers; none has a reason."""

    seconds: float | None
    note: str = ""
    given: bool = False
    """True where the scene gives it, because its drivers have none in common."""


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


def period_of(speeds: Sequence[float]) -> Period:
    """Return the least common period of turning drivers, whose speeds (rad/s) are positive."""
    if not speeds:
        return Period(None, "No driver turns, so there is no period.")
    if min(speeds) < SLOWEST:
        return Period(
            None, f"A driver turns slower than {SLOWEST:g} rad/s, so there is no period in reach."
        )
    for base in speeds:  # each is held against it: of 1, 40 and 1600 all keep to 40
        turns = _turns_until_all_come_round(base, speeds)
        if turns is not None:
            return Period(turns * (2.0 * math.pi / base))
    first = speeds[0]
    other = next(s for s in speeds if _turns_until_all_come_round(first, [s]) is None)
    return Period(
        None,
        f"The drivers' speeds {first:g} and {other:g} rad/s have no common period;"
        " choose speeds in a ratio of whole numbers.",
    )


def _turns_until_all_come_round(base: float, speeds: Sequence[float]) -> int | None:
    """Return how often a driver turns until others have made whole turns; None: they never do."""
    turns = 1
    for speed in speeds:
        ratio = _whole_numbers(speed / base)
        exact = ratio > 0 and abs(float(ratio) * base - speed) <= RATIO_TOLERANCE * speed
        if not exact or ratio.numerator > LARGEST_RATIO:
            return None
        turns = math.lcm(turns, ratio.denominator)
    return turns


@lru_cache(maxsize=1024)
def _whole_numbers(ratio: float) -> Fraction:
    return Fraction(ratio).limit_denominator(LARGEST_RATIO)


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


def section_offset(scene: Scene, period: float, crank_angle: float) -> float:
    """Return the time of the first section, s: when the first driver has turned that far.

    A motion that is a function turns once in its period.
    """
    return min(crank_angle / first_speed(scene), period) if crank_angle else 0.0
