"""Instants at which companions are compared: a few hundred, the finer the earlier.

Errors grow by factors, so the time until which a motion is known is wanted to a share of itself.
The instants are whole multiples of a finest step up to `first` of them; then, octave after octave,
first / 2 more at twice the step. The last one is the end of the run.

Where FIRST of them would meet the drive at the same few phases again and again, as those of 2^k
periods, which are whole parts of a period apart, there are a few more.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from jointplay.records.arrays import Floats, Integers

FIRST = 128
"""Instants of the first octaves; all later ones are a 64th to a 128th of their time apart."""
MOST_OCTAVES = 40
WIDEST = 0.1
"""Share of a period in which late instants may have no phase."""


@dataclass(frozen=True)
class Instants:
    """Instants of a run."""

    duration: float
    """End of the run, s."""
    octaves: int
    """Doublings of the step."""
    first: int = FIRST
    """Number of instants at the finest step, even."""

    @classmethod
    def over(cls, duration: float, period: float) -> Instants:
        """Return the instants of a run that resolve its period, s, and late ones its phases."""
        mantissa, exponent = math.frexp(max(duration / period, 1.0))
        octaves = min(exponent - 1 if mantissa == 0.5 else exponent, MOST_OCTAVES)
        instants = cls(duration, octaves)
        while instants.misses_phases(period) and instants.first < 2 * FIRST:
            instants = cls(duration, octaves, instants.first + 2)
        return instants

    def misses_phases(self, period: float) -> bool:
        """Return whether late instants leave out a part of a period (s) of what drives a motion.

        The later half counts, if it is a period or more: it stands for half of the time.
        """
        late = self.time[self.time >= 0.5 * self.duration]
        if late[-1] - late[0] < period:
            return False
        phases = np.sort(late / period % 1.0)
        return bool(np.diff([*phases, phases[0] + 1.0]).max() > WIDEST)

    @property
    def finest(self) -> float:
        """First step, s."""
        return self.duration / self.last

    @property
    def last(self) -> int:
        """Index of the end of the run, in finest steps."""
        return self.first << self.octaves

    def stride(self, index: int) -> int:
        """Return the finest steps between the instants about an index."""
        stride = 1
        while index > self.first * stride:
            stride *= 2
        return stride

    @property
    def index(self) -> Integers:
        """All instants, (count,), in finest steps."""
        pieces = [np.arange(self.first + 1, dtype=np.int64)]
        half = np.arange(self.first // 2 + 1, self.first + 1, dtype=np.int64)
        pieces += [half << octave for octave in range(1, self.octaves + 1)]
        return np.concatenate(pieces)

    @property
    def time(self) -> Floats:
        """All instants, (count,), s."""
        return np.asarray([*(self.index[:-1] * self.finest), self.duration], np.float64)
