"""Numbers of points, and of their channels, put together from the parts of blocks."""

from bisect import bisect_right
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from jointplay.records.point import Failure
from jointplay.storage.studies.part import Floats, Part


@dataclass(frozen=True)
class Points:
    """Consecutive points of a study; what is not known is NaN, or waiting."""

    status: NDArray[np.uint8]
    counts: NDArray[np.int32]
    peaks: Floats
    """(points, channels, 4): minimum, its time, maximum, its time."""
    failures: dict[int, Failure]
    """By point of the study."""
    statistics: dict[str, Floats]
    indicators: dict[str, Floats]


def together(
    part_of: Callable[[int], Part | None],
    blocks: Sequence[tuple[int, int]],
    channels: int,
    start: int,
    stop: int,
) -> Points:
    """Put points `start` to `stop` - 1 together from the parts of their blocks.

    Parameters
    ----------
    part_of
        Gives the part of a block by its index; none while it waits.
    blocks
        (first, count) of all blocks.
    channels
        Number of channels whose peaks are kept.
    """
    points = Points(
        np.zeros(stop - start, np.uint8),
        np.zeros(stop - start, np.int32),
        np.full((stop - start, channels, 4), np.nan),
        {},
        {},
        {},
    )
    begin = max(bisect_right(blocks, start, key=lambda block: block[0]) - 1, 0)
    for index in range(begin, len(blocks)):
        first, count = blocks[index]
        if first >= stop:
            break
        part = part_of(index)
        if part is not None:
            low, high = max(first, start), min(first + count, stop)
            _copy(part, slice(low - first, high - first), points, slice(low - start, high - start))
            points.failures.update(
                {p: failure for p, failure in part.failures.items() if start <= p < stop}
            )
    return points


def _copy(part: Part, source: slice, points: Points, target: slice) -> None:
    points.status[target] = part.status[source]
    points.counts[target] = part.counts[source]
    points.peaks[target] = part.peaks[source]
    for found, known in (
        (part.statistics, points.statistics),
        (part.indicators, points.indicators),
    ):
        for name, numbers in found.items():
            if name not in known:
                known[name] = np.full(len(points.status), np.nan)
            known[name][target] = numbers[source]
