"""Angles within one turn: what goes round is where it was after each whole turn."""

import numpy as np

from jointplay.records.arrays import Floats

_TURN = 2.0 * np.pi


def within_a_turn(angles: Floats) -> Floats:
    """Return angles [rad] as they are, or within one turn if they reach over more than one.

    That turn has the middle of the angles, to a quarter of a turn, in its own middle: angles that
    are equal but for rounding do not come apart at its ends.  NaN stays NaN.
    """
    finite = angles[np.isfinite(angles)]
    if not finite.size or np.ptp(finite) <= _TURN:
        return angles
    direction = np.arctan2(np.sin(finite).mean(), np.cos(finite).mean())
    middle = np.round(direction / (_TURN / 4.0)) * _TURN / 4.0
    return np.asarray(angles - _TURN * np.round((angles - middle) / _TURN), np.float64)
