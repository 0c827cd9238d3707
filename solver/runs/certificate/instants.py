"""Instants at which companions are compared: a few hundred, the finer the earlier.

Errors grow by factors, so the time until which a motion is known is wanted to a share of itself.
The instants are whole multiples of a finest step up to FIRST of them; then, octave after octave,
FIRST / 2 more at twice the step. The last one is the end of the run.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from jointplay.records.arrays import Floats, Integers

FIRST = 128
"""Instants of the first octaves; all later ones are a 64th to a 128th of their time apart."""
MOST_OCTAVES = 40


@dataclass(frozen=True)
class Instants:
    """Instants of a run."""

    duration: float
    """End of the run, s."""
    octaves: int
    """Doublings of the step."""

    @classmethod
    def over(cls, duration: float, unit: float) -> Instants:
        """Return the instants of a run (s) of which a unit, such as its period, is resolved."""
        mantissa, exponent = math.frexp(max(duration / unit, 1.0))
        wanted = exponent - 1 if mantissa == 0.5 else exponent
        return cls(duration, min(wanted, MOST_OCTAVES))

    @property
    def finest(self) -> float:
        """First step, s: the duration by a power of two, so that no multiple is rounded."""
        return self.duration / self.last

    @property
    def last(self) -> int:
        """Index of the end of the run, in finest steps."""
        return int(FIRST << self.octaves)

    def stride(self, index: int) -> int:
        """Return the finest steps between the instants about an index."""
        stride = 1
        while index > FIRST * stride:
            stride *= 2
        return stride

    @property
    def index(self) -> Integers:
        """All instants, (count,), in finest steps."""
        pieces = [np.arange(FIRST + 1, dtype=np.int64)]
        half = np.arange(FIRST // 2 + 1, FIRST + 1, dtype=np.int64)
        pieces += [half << octave for octave in range(1, self.octaves + 1)]
        return np.concatenate(pieces)

    @property
    def time(self) -> Floats:
        """All instants, (count,), s."""
        return np.asarray(self.index * self.finest, np.float64)
