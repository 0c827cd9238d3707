"""The least common period of drivers that turn at constant speeds, if they have one in reach."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache

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
    given: bool = False
    """True where the scene gives it, because its drivers have none in common."""


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
