"""Results as the service sends them, as numpy arrays with their units."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class ChannelSeries:
    """One channel over the samples: ``values`` (n,), in ``unit``."""

    unit: str
    long_name: str
    values: NDArray[np.float64]


@dataclass(frozen=True)
class _Sampled:
    """Channels over shared times.

    ``time`` (n,) in s; ``complete`` says whether the run reached its end.
    """

    time: NDArray[np.float64]
    channels: dict[str, ChannelSeries]
    complete: bool

    def __getitem__(self, channel: str) -> NDArray[np.float64]:
        """Return the values of ``channel``, (n,)."""
        return self.channels[channel].values

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

    @classmethod
    def from_document(cls, document: dict[str, Any]) -> Self:
        """Read the service's JSON."""
        return cls(
            time=_floats(document["time"]["values"]),
            channels={
                name: ChannelSeries(one["unit"], one["long_name"], _floats(one["values"]))
                for name, one in document["channels"].items()
            },
            complete=document["complete"],
        )


@dataclass(frozen=True)
class History(_Sampled):
    """Channels on the output grid."""


@dataclass(frozen=True)
class Section(_Sampled):
    """Channels at the Poincare sections; ``note`` says why there are none, else is empty."""

    note: str = ""

    @classmethod
    def from_document(cls, document: dict[str, Any]) -> Self:
        """Read the service's JSON."""
        sampled = _Sampled.from_document(document)
        return cls(sampled.time, sampled.channels, sampled.complete, document["note"])


@dataclass(frozen=True)
class Peak:
    """Signed extremes of one channel, in ``unit``, each with its time in s.

    NaN where nothing was computed.
    """

    unit: str
    minimum: float
    minimum_time: float
    maximum: float
    maximum_time: float

    @classmethod
    def from_document(cls, document: dict[str, Any]) -> Self:
        """Read the service's JSON."""
        names = ("minimum", "minimum_time", "maximum", "maximum_time")
        return cls(document["unit"], *_floats([document[name] for name in names]).tolist())


@dataclass(frozen=True)
class Impacts:
    """Contacts in order of release, one row each; arrays have shape (n,).

    ``onset`` and ``release`` in s (release NaN: in contact at the end), ``approach_rate`` in
    m/s, ``peak_force`` in N, ``impulse`` in N s.
    """

    joint: list[str]
    onset: NDArray[np.float64]
    release: NDArray[np.float64]
    approach_rate: NDArray[np.float64]
    peak_force: NDArray[np.float64]
    impulse: NDArray[np.float64]

    @classmethod
    def from_rows(cls, rows: Sequence[dict[str, Any]]) -> Self:
        """Read the rows of the service's JSON."""
        names = ("onset", "release", "approach_rate", "peak_force", "impulse")
        columns = {name: _floats([row[name] for row in rows]) for name in names}
        return cls(joint=[row["joint"] for row in rows], **columns)


def _floats(values: list[float | None]) -> NDArray[np.float64]:
    return np.array(values, dtype=np.float64)  # null, where nothing was computed, becomes NaN
