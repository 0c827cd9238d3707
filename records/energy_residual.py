"""The energy residual of each run of an accuracy-study, also where an earlier version stored it."""

from typing import Final

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.records.study import StudySource

RELATIVE_ENERGY_RESIDUAL: Final = "relative_energy_residual"
"""Name of the number of a run: the residual divided by what contacts and friction took."""
_EARLIER: Final = "astray"
"""Its name in stores of version 0.1.0."""


def relative_energy_residuals(source: StudySource) -> Floats:
    """Return (points,) them; NaN where one is not known yet, and where nothing was taken."""
    unknown = np.full(source.points, np.nan)
    earlier = source.statistics.get(_EARLIER, unknown)
    return source.statistics.get(RELATIVE_ENERGY_RESIDUAL, earlier)
