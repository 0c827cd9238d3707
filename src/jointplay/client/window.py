"""Channels over a window of time, as numpy arrays with their units."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, Self

import numpy as np

from jointplay.records.channel import Channel
from jointplay.records.resolution import Resolution
from jointplay.records.run import Dataset, Floats


@dataclass(frozen=True)
class ChannelSeries:
    """One channel over the times of its window: ``values`` (n,), in ``unit``."""

    unit: str
    long_name: str
    values: Floats


@dataclass(frozen=True)
class Window:
    """Channels over shared times; ``window["A.normal_force"]`` are the values of one, (n,).

    Attributes
    ----------
    time
        (n,) in s.
    channels
        By name.
    complete
        The run reached its end.
    exact
        These are values: samples, or those of the instants asked for.  Otherwise each span of time
        became two entries: its smallest value at its beginning, its largest at its end.  A line
        through them shows every peak; ``values.reshape(-1, 2)`` has minimum and maximum side by
        side.
    between_samples
        Extremes are those of the trajectory, between its samples too.
    note
        What is to be known of the numbers, such as why they are of samples only; else empty.
    resolution
        What the numbers were computed from: steps, intervals between samples, or samples.
    """

    time: Floats
    channels: dict[str, ChannelSeries]
    complete: bool
    exact: bool = True
    note: str = ""
    between_samples: bool = False
    resolution: Resolution | None = None

    def __getitem__(self, channel: str) -> Floats:
        """Return the values of ``channel``, (n,)."""
        return self.channels[channel].values

    @classmethod
    def from_document(cls, document: dict[str, Any]) -> Self:
        """Read the service's JSON: samples, or the extremes of groups of samples."""
        exact = "bins" not in document
        if exact:
            time = floats(document["time"]["values"])
            columns = document["channels"]
        else:
            time = pairs(document["bins"]["first"], document["bins"]["last"])
            columns = document["extremes"]
        channels = {
            name: ChannelSeries(
                one["unit"],
                one["long_name"],
                floats(one["values"]) if exact else pairs(one["minimum"], one["maximum"]),
            )
            for name, one in columns.items()
        }
        note, between = document.get("note", ""), document.get("exact", False)
        found = Resolution.from_document(document.get("resolution"))
        return cls(time, channels, document["complete"], exact, note, between, found)

    def dataset(self) -> Dataset:
        """Return the window as exports take it."""
        return Dataset(
            attributes={"exact": self.exact},
            channels=[
                Channel(name, one.unit, one.long_name) for name, one in self.channels.items()
            ],
            time=self.time,
            values={name: one.values for name, one in self.channels.items()},
            complete=self.complete,
        )

    @classmethod
    def joined(cls, pieces: Sequence[Self]) -> Self:
        """Put consecutive windows of the same channels together."""
        if len(pieces) == 1:
            return pieces[0]
        return replace(
            pieces[0],
            time=np.concatenate([piece.time for piece in pieces]),
            channels={
                name: replace(one, values=np.concatenate([piece[name] for piece in pieces]))
                for name, one in pieces[0].channels.items()
            },
        )


def floats(values: Sequence[float | None]) -> Floats:
    """Return numbers as an array; null, where nothing was computed, becomes NaN."""
    return np.array(values, dtype=np.float64)


def pairs(first: Sequence[float | None], second: Sequence[float | None]) -> Floats:
    """Return (2n,) of two columns, one of each in turn."""
    return np.column_stack([floats(first), floats(second)]).ravel()
