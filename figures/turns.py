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
    return _about(angles, np.round(direction / (_TURN / 4.0)) * _TURN / 4.0)


def beside(angles: Floats, others: Floats) -> Floats:
    """Return angles [rad] within the turn that has the middle of others, within one, in its own.

    As they are where no other is known.
    """
    finite = others[np.isfinite(others)]
    return _about(angles, 0.5 * (finite.min() + finite.max())) if finite.size else angles


def _about(angles: Floats, middle: float) -> Floats:
    return np.asarray(angles - _TURN * np.round((angles - middle) / _TURN), np.float64)
