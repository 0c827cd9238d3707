"""Book of a bin: extremes of all rows of the channel block, and what is known of each beforehand.

An array (`LINES`, width), whose first lines are the numbers of `records.peak.PEAK`: a column for
each row, and some more that make the width a multiple of eight. Of a row that nobody asks for, no
value is ever a new extreme.
"""

import math

import numpy as np
from numpy.typing import NDArray

from jointplay.records.arrays import Floats
from jointplay.records.peak import HIGHEST, LOWEST
from jointplay.solver.kernels.layout import INSTANTS

RANGE = 4
"""Line of each channel's range as far as it is known: extremes are sharp against that."""
ROUNDING = 5
"""Line of what each channel moves by where it is only rounded, as far as that was seen."""
LINES = 6


def blank_book(rows: int, wanted: NDArray[np.int64], ranges: Floats) -> Floats:
    """Return a book of so many rows, of which some are wanted, with the ranges (wanted,) of these.

    ranges : 0 where a range is not known.
    """
    book = np.zeros((LINES, -(-rows // INSTANTS) * INSTANTS))
    book[LOWEST], book[HIGHEST] = -math.inf, math.inf
    book[LOWEST, wanted], book[HIGHEST, wanted] = math.inf, -math.inf
    book[RANGE, wanted] = ranges
    return book
