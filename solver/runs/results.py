"""What a simulation hands out: slices while it runs, a summary at any time."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

IMPACT = np.dtype(
    [
        ("joint", "i4"),
        ("onset", "f8"),
        ("release", "f8"),
        ("approach_rate", "f8"),
        ("peak_force", "f8"),
        ("impulse", "f8"),
    ]
)
"""One contact: joint index, times (s; release not a number: it lasts beyond the run), penetration
rate at onset (m/s), largest normal force (N), its integral (N s)."""


@dataclass(frozen=True)
class Slice:
    """What became known since the last slice; samples and sections continue without gaps."""

    time: float
    """Simulated time reached, s."""
    fraction: float
    first_sample: int
    sample_time: Floats
    samples: Floats
    """(samples, channels), in the order of the admission's channels."""
    first_section: int
    section_time: Floats
    sections: Floats
    """(sections, channels)."""
    impacts: NDArray[np.void]
    """Contacts that ended, of dtype `IMPACT`, in the order of their release."""


@dataclass(frozen=True)
class Peak:
    """Signed extremes of a channel over the whole run, and their times (s)."""

    minimum: float
    minimum_time: float
    maximum: float
    maximum_time: float

    def scaled(self, factor: float, offset: float) -> Peak:
        """Return the extremes of factor * channel + offset."""
        low = (factor * self.minimum + offset, self.minimum_time)
        high = (factor * self.maximum + offset, self.maximum_time)
        return Peak(*low, *high) if factor >= 0.0 else Peak(*high, *low)


@dataclass(frozen=True)
class Summary:
    """Extremes of the selected channels, and what the run cost and conserved."""

    peaks: dict[str, Peak]
    statistics: dict[str, Any]
