"""A quantity over two axes, at coarser resolution.

Values of a cell are averaged, labels never: a cell has the label that more than half of its points
have, else it is mixed.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from jointplay.records.arrays import Flags, Floats
from jointplay.records.coarse_to_fine import COARSEST
from jointplay.records.motion import MIXED, WAITING, Labels


def averaged(values: Floats, stride: int) -> Floats:
    """Return the means of cells of `stride` points along each side; NaN where nothing is known."""
    known = np.isfinite(values)
    counts = _sums(known, stride)
    with np.errstate(invalid="ignore"):
        return np.asarray(_sums(np.where(known, values, 0.0), stride) / counts)


def in_majority(labels: Labels, stride: int) -> Labels:
    """Return the labels of cells of `stride` points along each side."""
    known = _sums(labels != WAITING, stride)
    found = np.where(known > 0, MIXED, WAITING).astype(np.uint8)
    for label in np.unique(labels):
        if label != WAITING:
            found[2 * _sums(labels == label, stride) > known] = label
    return found


def filled_in(values: NDArray[Any], known: Flags) -> NDArray[Any]:
    """Return values with those of the next coarser known point where a point is not known yet.

    So a chart that is being computed shows a picture from the beginning, which sharpens.
    """
    stride = 1 << COARSEST
    coarse, there = values[::stride, ::stride], known[::stride, ::stride]
    while stride > 1:
        stride //= 2
        fine, own = values[::stride, ::stride], known[::stride, ::stride]
        height, width = fine.shape
        inherited = coarse.repeat(2, axis=0).repeat(2, axis=1)[:height, :width]
        passed = there.repeat(2, axis=0).repeat(2, axis=1)[:height, :width]
        coarse, there = np.where(own, fine, inherited), own | passed
    return np.where(there, coarse, values)


def _sums(numbers: NDArray[Any], stride: int) -> Floats:
    """Return the sums of cells; those at the upper and right edge may have fewer points."""
    rows, columns = (np.arange(0, size, stride) for size in numbers.shape)
    by_row = np.add.reduceat(numbers, rows, axis=0, dtype=np.float64)
    return np.asarray(np.add.reduceat(by_row, columns, axis=1))
