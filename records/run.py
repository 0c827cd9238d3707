"""Readable results of one run: named channels over time, wherever they are stored, or in memory."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from jointplay.records.arrays import Floats as Floats
from jointplay.records.between_samples import BetweenSamples
from jointplay.records.channel import Channel
from jointplay.records.impact import IMPACT
from jointplay.records.peak import Peak

Columns = tuple[Floats, dict[str, Floats]]
"""(k,) times [s], and by channel (k,) values in its unit."""


@dataclass(frozen=True)
class LabelledArray:
    """Doubles of any shape, with a name for each dimension, units and meaning."""

    values: Floats
    dimensions: tuple[str, ...]
    attributes: Mapping[str, Any]


@dataclass(frozen=True)
class CertificateRecord:
    """Estimated errors of one run: a JSON document of finite numbers, and arrays by name.

    The document has "horizon" and "converged" among others; the arrays are those that
    `records.certificate` names, their columns in the order of channels.
    """

    attributes: Mapping[str, Any]
    arrays: Mapping[str, LabelledArray]


class Source(Protocol):
    """Results of one run; a reader of the results store is one as it is."""

    @property
    def attributes(self) -> Mapping[str, Any]:
        """At least "scene", the scene document with its parameters set."""

    @property
    def channels(self) -> Sequence[Channel]:
        """Channels that were stored."""

    @property
    def joints(self) -> Sequence[str]:
        """Names of the contact pairs that the `joint` of an impact points to."""

    @property
    def complete(self) -> bool:
        """The run came to its end."""

    @property
    def samples(self) -> int:
        """Number of samples."""

    @property
    def trajectory(self) -> BetweenSamples | None:
        """Reads the run between its samples; None where only these are known."""

    def blocks(
        self, channels: Sequence[str] | None = None, start: int = 0, stop: int | None = None
    ) -> Iterator[Columns]:
        """Give samples `start` to `stop` - 1 in consecutive pieces that fit into memory."""

    def between(self, start: float | None, stop: float | None) -> tuple[int, int]:
        """Find the samples [first, last) of start <= time <= stop [s]; None is unbounded."""

    def sections(self, channels: Sequence[str] | None = None) -> Columns:
        """Give the Poincare sections."""

    def peaks(self) -> Mapping[str, Peak]:
        """Give the signed extremes by channel."""

    def impacts(self) -> NDArray[Any]:
        """Give the contacts in order of release: (j,) of dtype `records.impact.IMPACT`."""

    def certificate(self) -> CertificateRecord | None:
        """Give the estimated errors; none before the run's end, or where none were asked for."""


@dataclass(frozen=True)
class Dataset:
    """A `Source` in memory.

    Parameters
    ----------
    attributes
        Root attributes of the store; figures look at "scene".
    channels
        The channels there are; `values` may hold fewer, if the rest is never asked for.
    time, values
        (k,) ascending times [s] and (k,) values by channel.
    section_time, section_values
        The same for the Poincare sections.
    extremes
        Peaks by channel.
    contacts
        (j,) structured array of dtype `IMPACT`.
    joints
        Names of the contact pairs that the `joint` of a contact points to.
    complete
        The run came to its end.
    certified
        What is known of the errors.
    trajectory
        Reads the run between its samples.
    """

    attributes: Mapping[str, Any]
    channels: Sequence[Channel]
    time: Floats
    values: Mapping[str, Floats]
    section_time: Floats = field(default_factory=partial(np.empty, 0))
    section_values: Mapping[str, Floats] = field(default_factory=dict)
    extremes: Mapping[str, Peak] = field(default_factory=dict)
    contacts: NDArray[Any] = field(default_factory=partial(np.empty, 0, IMPACT))
    joints: Sequence[str] = ()
    complete: bool = True
    certified: CertificateRecord | None = None
    trajectory: BetweenSamples | None = None

    @property
    def samples(self) -> int:
        """Number of samples."""
        return len(self.time)

    def blocks(
        self, channels: Sequence[str] | None = None, start: int = 0, stop: int | None = None
    ) -> Iterator[Columns]:
        """Give samples `start` to `stop` - 1 in one piece."""
        names = [channel.name for channel in self.channels] if channels is None else channels
        window = slice(start, stop)
        yield self.time[window], {name: self.values[name][window] for name in names}

    def between(self, start: float | None, stop: float | None) -> tuple[int, int]:
        """Find the samples [first, last) of start <= time <= stop [s]; None is unbounded."""
        first = 0 if start is None else int(np.searchsorted(self.time, start, side="left"))
        last = (
            len(self.time) if stop is None else int(np.searchsorted(self.time, stop, side="right"))
        )
        return first, max(first, last)

    def sections(self, channels: Sequence[str] | None = None) -> Columns:
        """Give the Poincare sections."""
        names = list(self.section_values) if channels is None else channels
        return self.section_time, {name: self.section_values[name] for name in names}

    def peaks(self) -> Mapping[str, Peak]:
        """Give the signed extremes by channel."""
        return self.extremes

    def certificate(self) -> CertificateRecord | None:
        """Give what is known of the errors."""
        return self.certified

    def impacts(self) -> NDArray[Any]:
        """Give the contacts in order of release."""
        return self.contacts


def inside(time: Floats, start: float | None, stop: float | None) -> NDArray[np.bool_]:
    """Tell which times lie in start <= time <= stop [s]; None is unbounded."""
    low = -np.inf if start is None else start
    high = np.inf if stop is None else stop
    return (time >= low) & (time <= high)
