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
    """Return extremes of channels and the statistics that the job chose, by name, with units.

    Those of the scene's declared outputs come first, then those of contact forces.
    """
    declared = [one["name"] for one in source.attributes["scene"].get("outputs", ())]
    channels = sorted(
        source.channels,
        key=lambda one: (one.name not in declared, not one.name.endswith(".normal_force")),
    )
    found = {
        f"{one.name}.{end}": Channel(f"{one.name}.{end}", one.unit, f"{words} {one.long_name}")
        for one in channels
        for end, words in _EXTREMES.items()
    }
    chosen = source.attributes.get("meanings", {})
    return found | {name: Channel(name, *meaning) for name, meaning in chosen.items()}


def channel_of(source: StudySource, name: str) -> str | None:
    """Return the channel whose extremes an output is made of; None of a statistic."""
    channel, _, end = name.rpartition(".")
    known = end in _EXTREMES and channel in {one.name for one in source.channels}
    return channel if known else None


def channel_beneath(source: StudySource, name: str) -> str | None:
    """Return the channel that an output is an extreme or a statistic of; None of one of a joint."""
    channel, unit = name.rpartition(".")[0], outputs(source)[name].unit
    return channel if channel in {c.name for c in source.channels if c.unit == unit} else None


def output(source: StudySource, name: str) -> Floats:
    """Return (points,) one of `outputs`; NaN where it is not known."""
    channel, end = channel_of(source, name), name.rpartition(".")[2]
    if channel is None:
        return source.statistics.get(name, np.full(source.points, np.nan))
    peaks = source.peaks(channel)
    return peaks.maximum - peaks.minimum if end == "range" else np.asarray(getattr(peaks, end))
