"""Results of a simulation: slices while it runs, a summary at any time."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from jointplay.records.arrays import Floats
from jointplay.records.peak import Peak


@dataclass(frozen=True)
class Slice:
    """Results since the last slice; samples and sections continue without gaps."""

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
    steps: Floats
    """(steps, columns) accepted steps, see `dense_output.columns`; without columns: not kept."""
    intervals: Floats
    """(intervals, 1 + 2 channels) where steps are not kept: the sample at the end of each, then
    smallest and largest value of each channel in turn; without columns: there are none."""


@dataclass(frozen=True)
class Summary:
    """Extremes of the selected channels, and what the run cost and conserved."""

    peaks: dict[str, Peak]
    statistics: dict[str, Any]
