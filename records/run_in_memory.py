"""Results in memory, to be filled from what the service sends."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from jointplay.records.channel import Channel
from jointplay.records.impact import IMPACT
from jointplay.records.peak import Peak
from jointplay.records.run import CertificateLike, Columns, Floats


def _nothing() -> Floats:
    return np.empty(0)


def _no_impacts() -> NDArray[Any]:
    return np.empty(0, IMPACT)


@dataclass(frozen=True)
class Dataset:
    """A `records.run.Source` in memory.

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
        Names that the `joint` of a contact points to.
    complete
        The run came to its end.
    certified
        What is known of the errors.
    """

    attributes: Mapping[str, Any]
    channels: Sequence[Channel]
    time: Floats
    values: Mapping[str, Floats]
    section_time: Floats = field(default_factory=_nothing)
    section_values: Mapping[str, Floats] = field(default_factory=dict)
    extremes: Mapping[str, Peak] = field(default_factory=dict)
    contacts: NDArray[Any] = field(default_factory=_no_impacts)
    joints: Sequence[str] = ()
    complete: bool = True
    certified: CertificateLike | None = None

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

    def certificate(self) -> CertificateLike | None:
        """Give what is known of the errors."""
        return self.certified

    def impacts(self) -> NDArray[Any]:
        """Give the contacts in order of release."""
        return self.contacts
