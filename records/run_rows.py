"""Rows of one run's results, as a computation gives them and a store takes them."""

from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from jointplay.records.arrays import Floats
from jointplay.records.impact import IMPACT

_NONE = partial(np.empty, (0, 0))


@dataclass(frozen=True, kw_only=True)
class RunRows:
    """Consecutive rows: samples and sections go on where those before ended."""

    first_sample: int = 0
    """Index of the first sample in the run; samples before it are in earlier rows."""
    sample_time: Floats = field(default_factory=partial(np.empty, 0))
    """(samples,) s."""
    samples: Floats = field(default_factory=_NONE)
    """(samples, channels), in the order and the units of the run's channels."""
    first_section: int = 0
    section_time: Floats = field(default_factory=partial(np.empty, 0))
    """(sections,) s."""
    sections: Floats = field(default_factory=_NONE)
    """(sections, channels)."""
    impacts: NDArray[Any] = field(default_factory=partial(np.empty, 0, IMPACT))
    """Contacts that ended, of dtype `IMPACT`, in the order of their release."""
    steps: Floats = field(default_factory=_NONE)
    """(steps, columns) accepted steps; without columns: they are not kept."""
    intervals: Floats = field(default_factory=_NONE)
    """(intervals, 1 + 2 channels) where steps are not kept: the sample at the end of each, then
    smallest and largest value of each channel in turn; without columns: there are none."""
