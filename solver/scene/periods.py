"""Periods of a scene's drivers: what a revolution is, and whether there is one."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache

from jointplay.solver.scene.document import Revolute, Scene

LARGEST_RATIO = 1000
"""Speeds whose ratio needs larger whole numbers than this count as incommensurate."""
SLOWEST = 1e-9
"""Speeds below, rad/s or m/s, give no time scale: a revolution takes two centuries."""
RATIO_TOLERANCE = 1e-12
"""Relative mismatch within which a ratio of speeds is taken as exact: rounding of the input."""


@dataclass(frozen=True)
class Period:
    """The least common period of the drivers; none has a reason."""

    seconds: float | None
    note: str = ""


def common_period(scene: Scene) -> Period:
    """Return the least time after which every driven angle is back; signs do not matter."""
    speeds: list[float] = []
    for driver in scene.drivers.values():
        if not isinstance(scene.joints[driver.joint], Revolute):
            if driver.speed != 0.0:
                return Period(None, "A driven slider never comes back, so there is no period.")
        elif driver.speed != 0.0:
            speeds.append(abs(driver.speed))
    return period_of(speeds)


def period_of(speeds: Sequence[float]) -> Period:
    """Return the least common period of turning drivers, whose speeds (rad/s) are positive."""
    if not speeds:
        return Period(None, "No driver turns, so there is no period and no Poincare section.")
    if min(speeds) < SLOWEST:
        return Period(
            None, f"A driver turns slower than {SLOWEST:g} rad/s, so there is no period in reach."
        )
    first = speeds[0]
    turns = Fraction(1)
    for speed in speeds[1:]:
        ratio = _whole_numbers(speed / first)
        exact = ratio > 0 and abs(float(ratio) * first - speed) <= RATIO_TOLERANCE * speed
        if not exact or ratio.numerator > LARGEST_RATIO:
            return Period(
                None,
                f"The drivers' speeds {first:g} and {speed:g} rad/s have no common period, so there"
                " is no Poincare section; choose speeds in a ratio of whole numbers.",
            )
        # the first driver makes `turns` turns until every other one has made whole turns
        whole = Fraction(ratio.denominator)
        turns = Fraction(math.lcm(int(turns), int(whole)))
    return Period(float(turns) * (2.0 * math.pi / first))


@lru_cache(maxsize=1024)
def _whole_numbers(ratio: float) -> Fraction:
    return Fraction(ratio).limit_denominator(LARGEST_RATIO)


def characteristic_time(scene: Scene, length: float) -> float:
    """Return a time scale, s: the shortest driver period, else that of a pendulum, else 1 s."""
    turning = [abs(d.speed) for d in scene.drivers.values() if abs(d.speed) >= SLOWEST]
    if turning:
        return 2.0 * math.pi / max(turning)
    gravity = math.hypot(*scene.gravity)
    return 2.0 * math.pi * math.sqrt(length / gravity) if gravity > 0.0 else 1.0


def section_offset(scene: Scene, period: float, crank_angle: float) -> float:
    """Return the time of the first section, s: when the first driver has turned that far."""
    speeds = [abs(driver.speed) for driver in scene.drivers.values() if driver.speed != 0.0]
    return min(crank_angle / speeds[0], period) if crank_angle else 0.0
