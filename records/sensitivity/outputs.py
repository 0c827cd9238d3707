"""Numbers of a study's points whose sensitivity can be asked for."""

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.records.channel import Channel
from jointplay.records.study import StudySource

_EXTREMES = {
    "maximum": "largest value of",
    "minimum": "smallest value of",
    "range": "range of",
}


def outputs(source: StudySource) -> dict[str, Channel]:
    """Return extremes of channels and the statistics that the job chose, by name, with units."""
    found = {
        f"{one.name}.{end}": Channel(f"{one.name}.{end}", one.unit, f"{words} {one.long_name}")
        for one in source.channels
        for end, words in _EXTREMES.items()
    }
    chosen = source.attributes.get("meanings", {})
    return found | {name: Channel(name, *meaning) for name, meaning in chosen.items()}


def output(source: StudySource, name: str) -> Floats:
    """Return (points,) one of `outputs`; NaN where it is not known."""
    channel, _, end = name.rpartition(".")
    if end in _EXTREMES and channel in {one.name for one in source.channels}:
        peaks = source.peaks(channel)
        return peaks.maximum - peaks.minimum if end == "range" else getattr(peaks, end)
    return source.statistics.get(name, np.full(source.points, np.nan))
