"""Motions that do not recur, told apart by means and spreads, as far as their scatter allows."""

from dataclasses import dataclass
from typing import Final

import numpy as np

from jointplay.records.arrays import Flags, Floats, Integers

CLOSE: Final = 4.0
"""Standard errors within which a motion may have the mean of a group."""
APART: Final = 8.0
"""Standard errors beyond which it has another. What lies between is not told apart."""
_ROUNDS: Final = 20
"""In which the mean of a group is found, at most."""


@dataclass(frozen=True)
class MotionFeatures:
    """Means and spreads of motions, with what they scatter by."""

    values: Floats
    """(motions, columns)."""
    errors: Floats
    """(motions, columns) standard errors, positive; infinite: nothing is known."""
    angles: Flags
    """(columns,) of which whole turns do not count."""

    def apart(self, chosen: Integers, one: Floats) -> Floats:
        """Return (chosen, columns) by how much motions differ from given ones."""
        found = self.values[chosen] - one
        turns = np.round(found / (2.0 * np.pi)) * self.angles
        return np.asarray(found - 2.0 * np.pi * turns, np.float64)

    def distances(self, chosen: Integers, one: Floats, error: Floats) -> Floats:
        """Return (chosen,) largest differences from given ones, in standard errors of both."""
        errors = np.hypot(self.errors[chosen], error)
        return np.asarray((np.abs(self.apart(chosen, one)) / errors).max(axis=1), np.float64)


def clusters(motions: MotionFeatures) -> list[Integers]:
    """Return groups of motions, of indices each; some may be in none.

    One group of all: nothing tells them apart. Those of several groups differ beyond their scatter;
    a motion that lies between groups, or may be of two, is in none.
    """
    left = every = np.arange(len(motions.values))
    centres = []
    while len(left):
        centre, error = _centre(motions, left)
        centres.append((centre, error))
        beyond = motions.distances(left, centre, error) > APART
        beyond[0] = False  # whatever its group has become without it
        left = left[beyond]
    if len(centres) < 2:
        return [every]
    distances = np.stack([motions.distances(every, *one) for one in centres])
    alone = (distances <= APART).sum(axis=0) == 1
    nearest = distances.argmin(axis=0)
    groups = [np.flatnonzero(alone & (nearest == k)) for k in range(len(centres))]
    groups = [one for one in groups if len(one)]
    if len(groups) < 2 or 2 * int(alone.sum()) < len(every):
        return [every]
    return groups


def _centre(motions: MotionFeatures, left: Integers) -> tuple[Floats, Floats]:
    """Return the mean of those that are close to the first, and its error."""
    centre, error = motions.values[left[0]], motions.errors[left[0]]
    near = np.zeros(len(left), np.bool_)
    for _ in range(_ROUNDS):
        found = motions.distances(left, centre, error) <= CLOSE
        if not found.any() or (found == near).all():
            break
        near = found
        weights = motions.errors[left[near]] ** -2.0
        total = np.maximum(weights.sum(axis=0), np.finfo(np.float64).tiny)
        centre = centre + (weights * motions.apart(left[near], centre)).sum(axis=0) / total
        error = total**-0.5
    return centre, error
