"""Angles of a record without whole turns, cut where no points of it are near the cut."""

import numpy as np

from jointplay.records.arrays import Flags, Floats

TURN = 2.0 * np.pi
WIDEST = TURN / 8.0
"""Arc without points, rad, from which on a circle is not filled."""


def unwound(states: Floats, angles: Flags) -> Floats:
    """Return states, (n, d), the angles among them, (d,), within one turn about the first state.

    Each angle's circle is cut in the middle of the widest arc without points: a shaft that advances
    by half a turn from section to section has its points half a turn apart, not by chance on either
    side of a cut there.
    """
    found = np.array(states, np.float64)
    if len(found):
        for column in np.flatnonzero(angles):
            found[:, column] -= TURN * _turns(found[:, column])
    return found


def goes_round(angle: Floats) -> bool:
    """Return whether (n,) angles, rad, fill their circle: wherever it is cut, points are near."""
    within = np.sort(angle % TURN)
    return bool(np.diff(within, append=within[0] + TURN).max() < WIDEST)


def _turns(angle: Floats) -> Floats:
    """Return how often each of (n,) angles, rad, has passed the cut since the first."""
    within = np.sort(angle % TURN)
    gaps = np.diff(within, append=within[0] + TURN)
    widest = int(gaps.argmax())
    passed = np.floor((angle - (within[widest] + 0.5 * gaps[widest])) / TURN)
    return np.asarray(passed - passed[0], np.float64)
