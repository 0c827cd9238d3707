"""Numbers of points, and of their channels, put together from those of blocks."""

from bisect import bisect_right
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from jointplay.records.point import Failure
from jointplay.records.run import Floats

STATISTICS: Final = "statistics"
INDICATORS: Final = "indicators"
_MOST_CODES: Final = 255
_OTHER: Final = "other"


@dataclass
class Points:
    """Consecutive points of a study; what is not known is NaN, or waiting."""

    status: NDArray[np.uint8]
    counts: NDArray[np.int32]
    """(points,) sections."""
    peaks: Floats
    """(points, channels, 4): minimum, its time, maximum, its time."""
    failures: dict[int, Failure] = field(default_factory=dict)
    """By point of the study."""
    reasons: dict[int, str] = field(default_factory=dict)
    """Grounds of verdicts, by point of the study."""
    documents: dict[int, Mapping[str, Any]] = field(default_factory=dict)
    """Results that are no numbers of a point, by point of the study."""
    numbers: dict[str, Floats] = field(default_factory=dict)
    """(points,) by group (`STATISTICS` or `INDICATORS`) and name: ``statistics/steps``."""

    def column(self, name: str) -> Floats:
        """Give an array of `numbers` to be written to; it begins with NaN."""
        if name not in self.numbers:
            self.numbers[name] = np.full(len(self.status), np.nan)
        return self.numbers[name]

    def group(self, group: str) -> dict[str, Floats]:
        """Give the numbers of one group by name."""
        begin = f"{group}/"
        found = self.numbers.items()
        return {path.removeprefix(begin): one for path, one in found if path.startswith(begin)}

    def scalars(
        self, first: int, names: Sequence[str], codes: Sequence[str]
    ) -> dict[str, NDArray[Any]]:
        """Give every array of a sealed store that has one number a point.

        Parameters
        ----------
        first
            The first of these points in the study.
        names
            Of `numbers` that some point of the study has.
        codes
            Of failures, in the order of the attribute `failures`.
        """
        failure = np.zeros(len(self.status), np.uint8)
        failure_time = np.full(len(self.status), np.nan)
        position = {code: at for at, code in enumerate(codes, 1)}
        for point, found in self.failures.items():
            failure[point - first] = position.get(found.code) or position[_OTHER]
            failure_time[point - first] = found.time
        nothing = np.full(len(self.status), np.nan)
        return {
            "status": self.status,
            "count": self.counts,
            "failure": failure,
            "failure_time": failure_time,
            **{name: self.numbers.get(name, nothing) for name in names},
        }


def unknown(count: int, channels: int) -> tuple[NDArray[np.uint8], NDArray[np.int32], Floats]:
    """Give status, counts and peaks of points of which nothing is known."""
    peaks = np.full((count, channels, 4), np.nan)
    return np.zeros(count, np.uint8), np.zeros(count, np.int32), peaks


def ordered(names: Iterable[str]) -> list[str]:
    """Sort names of `Points.numbers`, statistics first."""
    return sorted(names, key=lambda name: (not name.startswith(STATISTICS), name))


def failure_codes(failures: Mapping[int, Failure]) -> list[str]:
    """List the codes of failures, in the order of the attribute `failures`.

    Only programs that hand in made-up results have more than fit a byte: the last ones are one.
    """
    codes = sorted({failure.code for failure in failures.values()})
    return codes if len(codes) <= _MOST_CODES else [*codes[: _MOST_CODES - 1], _OTHER]


def together(
    part_of: Callable[[int], Points | None],
    blocks: Sequence[Sequence[int]],
    channels: int,
    start: int,
    stop: int,
) -> Points:
    """Put points `start` to `stop` - 1 together from those of their blocks.

    Parameters
    ----------
    part_of
        Gives the points of a block by its index; none while it waits.
    blocks
        (first, count) of all blocks.
    channels
        Number of channels whose peaks are kept.
    """
    points = Points(*unknown(stop - start, channels))
    begin = max(bisect_right(blocks, start, key=lambda block: block[0]) - 1, 0)
    for index in range(begin, len(blocks)):
        first, count = blocks[index]
        if first >= stop:
            break
        part = part_of(index)
        if part is None:
            continue
        low, high = max(first, start), min(first + count, stop)
        source, target = slice(low - first, high - first), slice(low - start, high - start)
        points.status[target] = part.status[source]
        points.counts[target] = part.counts[source]
        points.peaks[target] = part.peaks[source]
        for name, numbers in part.numbers.items():
            points.column(name)[target] = numbers[source]
        points.failures |= {p: one for p, one in part.failures.items() if start <= p < stop}
        points.reasons |= {p: one for p, one in part.reasons.items() if start <= p < stop}
        points.documents |= {p: one for p, one in part.documents.items() if start <= p < stop}
    return points
