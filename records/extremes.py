"""Extremes of channels as quantities of the points of a study, such as `displacement.maximum`."""

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.records.channel import Channel
from jointplay.records.study import StudySource

_ENDS = ("minimum", "maximum")


def extremes(source: StudySource) -> dict[str, Channel]:
    """Return the extremes of the channels of a study, by name."""
    return {
        f"{one.name}.{end}": Channel(f"{one.name}.{end}", one.unit, f"{end} of {one.name}")
        for one in source.channels
        for end in _ENDS
    }


def extreme(source: StudySource, name: str) -> Floats:
    """Return (points,) one of `extremes`, in the unit of its channel."""
    channel, _, end = name.rpartition(".")
    return np.asarray(getattr(source.peaks(channel), end), np.float64)
