"""Points of a map that is refined that have the results of another point of their cell."""

from typing import Final

import numpy as np

from jointplay.records.study import StudySource

INHERITED: Final = "inherited"
"""Name of the number that is 1 at such a point, and 0 at one that was computed."""


def inheriting(source: StudySource) -> int:
    """Return how many points of a study inherit so far."""
    return int(np.count_nonzero(source.statistics.get(INHERITED, np.zeros(0)) == 1.0))
