"""What a block of a study hands out while it runs."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


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
    """How one point ended and what is known of it beside its sections."""

    point: int
    code: str
    """Empty when it came to its end, else the failure's code."""
    detail: str
    """The failure as a sentence, else empty."""
    time: float
    """Simulated time reached, s."""
    peaks: Floats
    """(channels, 4): minimum, its time, maximum, its time; (0, 4) where none are kept."""
    statistics: dict[str, float]
    indicators: dict[str, float]


@dataclass(frozen=True)
class StudySlice:
    """What became known since the last slice."""

    fraction: float
    """Of the block, 0..1."""
    started: tuple[int, ...]
    """Points whose computing began."""
    rows: tuple[SectionRows, ...]
    ended: tuple[PointEnd, ...]
