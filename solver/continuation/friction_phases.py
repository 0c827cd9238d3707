"""Phases of friction in a period: how often a slip sticks, and how often it slides one way.

Friction laws here turn over within a ramp of slip speeds, which every slip passes that turns round.
It sticks there if it leaves the ramp on the side where it came from, or if it stays longer than the
slow passage of a fold takes, (tau / T)^(2/3) of the period T (Mishchenko and Rozov 1980,
Differential Equations with Small Parameters and Relaxation Oscillations); tau is the time that the
ramp takes at the rate of the slip beside it. As the ramp becomes narrow, that is where friction
comes to hold all other forces (di Bernardo et al. 2008, Piecewise-smooth Dynamical Systems,
chapter 8): 2e-3 of the force away where tau is 1e-3 of the period.
"""

import numpy as np

from jointplay.records.arrays import Flags, Floats

SLOW = 2.0 / 3.0
"""Power of the time in which the ramp is passed."""
APART = 2
"""Side of a slip while its pair is apart."""
TINY = 1e-300
"""Change of a slip between two rows at least: of one that rests there it is 0."""


def phases(
    slip: Floats, low: float, high: float, touching: Flags | None = None, contacts: int = 0
) -> tuple[int, int]:
    """Return how often a slip sticks, and how often it slides, in a period.

    slip : (count + 1,) equally far apart in time, the first and the last a period.
    low, high : ends of the ramp, in its unit.
    touching : (count + 1,) of a pair, not always. Each of its `contacts` begins and ends sliding,
        as its force is small there; those between two rows slide once.
    """
    around = slip[:-1]
    side = (around > high).astype(np.int64) - (around < low)
    if touching is not None:
        side[~touching[:-1]] = APART
    begins = np.flatnonzero(side != np.roll(side, 1)).tolist()
    if not begins:
        return int(side[0] == 0), contacts + int(abs(side[0]) == 1)
    held = 0
    for first, behind in zip(begins, [*begins[1:], begins[0]], strict=True):
        beside = side[first - 1], side[behind]
        if side[first] == 0 and APART not in beside:
            same = beside[0] == beside[1]
            held += int(same or _stays(around, low, high, first - 1, behind))
    slides, seen = (int(np.count_nonzero(abs(side[begins]) == one)) for one in (1, APART))
    return held, slides - seen + contacts


def _stays(around: Floats, low: float, high: float, before: int, behind: int) -> bool:
    """Return whether a slip sticks in the ramp, from a row before that to one behind."""
    rows = len(around)
    entry, early = float(around[before]), float(around[before - 1])
    leave, late = float(around[behind]), float(around[(behind + 1) % rows])
    begin = before + _passes(entry, float(around[(before + 1) % rows]), low, high)
    end = behind - 1 + _passes(float(around[behind - 1]), leave, low, high)
    fastest = max(abs(entry - early), abs(late - leave), TINY) * rows
    return bool((end - begin) % rows > ((high - low) / fastest) ** SLOW * rows)


def _passes(one: float, other: float, low: float, high: float) -> float:
    """Return after which share of the way from one slip to another an end of the ramp is passed."""
    edge = high if max(one, other) > high else low
    return (edge - one) / (other - one)
