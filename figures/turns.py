"""Angles within one turn: what goes round is where it was after each whole turn."""

import numpy as np

from jointplay.records.arrays import Floats

_TURN = 2.0 * np.pi
_CLEAR = 1e-3 * _TURN
"""Distance of angles from the ends of their turn at which rounding takes none across."""


def within_a_turn(angles: Floats) -> Floats:
    """Return angles [rad] as they are, or within one turn if they reach over more than one.

    That turn has the middle of the angles, to a quarter of a turn, in its own middle; or, where
    angles are at its ends, such as those of a wheel that makes a quarter of a turn each time, that
    sixteenth of a turn whose ends are farthest from all. So angles that are equal but for rounding
    do not come apart. NaN stays NaN.
    """
    finite = angles[np.isfinite(angles)]
    if not finite.size or np.ptp(finite) <= _TURN:
        return angles
    direction = np.arctan2(np.sin(finite).mean(), np.cos(finite).mean())
    usual = np.round(direction / (_TURN / 4.0)) * _TURN / 4.0
    middles = np.append(usual, np.arange(-7, 9) * _TURN / 16.0)
    clear = [
        np.abs(_about(finite, middle + _TURN / 2.0) - middle - _TURN / 2.0).min()
        for middle in middles
    ]
    best = 0 if clear[0] > _CLEAR or max(clear) < _CLEAR else int(np.argmax(clear))
    return _about(angles, middles[best])


def beside(angles: Floats, others: Floats) -> Floats:
    """Return angles [rad] within the turn that has the middle of others, within one, in its own.

    As they are where no other is known.
    """
    finite = others[np.isfinite(others)]
    return _about(angles, 0.5 * (finite.min() + finite.max())) if finite.size else angles


def _about(angles: Floats, middle: float) -> Floats:
    return np.asarray(angles - _TURN * np.round((angles - middle) / _TURN), np.float64)
