"""Points of a study: their states, and what becomes known of them while they are computed."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import IntEnum
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from jointplay.records.arrays import Flags, Floats


class PointStatus(IntEnum):
    """State of a point; stores keep its number."""

    waiting = 0
    running = 1
    done = 2
    failed = 3


ENDED: Final = (PointStatus.done, PointStatus.failed)


def has_ended(status: NDArray[np.uint8]) -> Flags:
    """Return whether each point has ended, by its status."""
    return np.isin(status, ENDED)


class Failure(NamedTuple):
    """Reason for which a point has no results, or not all."""

    code: str
    """The reason for programs, for example ``step-size-underflow``."""
    detail: str
    """The reason as a sentence."""
    time: float
    """Simulated time reached [s]."""


@dataclass(frozen=True)
class SectionRows:
    """Sections of one point that became known; they continue without gaps."""

    point: int
    first: int
    """Index of the first row among the point's recorded sections."""
    time: Floats
    """(k,) s since the start of the point's run."""
    values: Floats
    """(k, observables), in the order of the study."""


@dataclass(frozen=True)
class PointEnd:
    """End of one point, and its numbers beside its sections."""

    point: int
    code: str
    """Empty when it came to its end, else the failure's code."""
    detail: str
    """The failure as a sentence, else empty."""
    time: float
    """Simulated time reached, s."""
    peaks: Floats
    """(channels, 4): minimum, its time, maximum, its time; (0, 4) where none are kept."""
    statistics: Mapping[str, float]
    """Numbers by name; the same names at every point that came to its end."""
    indicators: Mapping[str, float]
    """The same for what tells regular from chaotic motion."""
    reason: str = ""
    """Grounds of the verdict, and of indicators that say nothing; empty where none were wanted."""
    document: Mapping[str, Any] | None = None
    """Results that are no numbers of a point, as JSON has them; none of most kinds."""


@dataclass(frozen=True)
class StudySlice:
    """Points' news since the last slice."""

    fraction: float
    """Part of the block that is done, 0..1."""
    started: Sequence[int]
    """Points whose computing began."""
    rows: Sequence[SectionRows]
    """New sections."""
    ended: Sequence[PointEnd]
    """Points that ended, each once, after all their sections."""
