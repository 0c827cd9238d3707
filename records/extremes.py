"""Extremes of channels as quantities of the points of a study, such as `displacement.maximum`."""

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.records.channel import Channel
from jointplay.records.peak import PeakColumns
from jointplay.records.point import PointStatus
from jointplay.records.study import StudySource

_ENDS = ("minimum", "maximum")


def extremes(source: StudySource) -> dict[str, Channel]:
    """Return the extremes of the channels of a study, by name."""
    return {
        f"{one.name}.{end}": Channel(f"{one.name}.{end}", one.unit, f"{end} of {one.name}")
        for one in source.channels
        for end in _ENDS
    }


def whole_peaks(source: StudySource, channel: str) -> PeakColumns:
    """Return the extremes of points that came to their end; NaN of all others.

    A point that failed has those up to there, which mean nothing beside extremes of whole runs.
    """
    failed = source.status == PointStatus.failed
    return PeakColumns(*(np.where(failed, np.nan, one) for one in source.peaks(channel)))


def extreme(source: StudySource, name: str) -> Floats:
    """Return (points,) one of `extremes`, in the unit of its channel; NaN of points that failed."""
    channel, _, end = name.rpartition(".")
    return np.asarray(getattr(whole_peaks(source, channel), end), np.float64)
