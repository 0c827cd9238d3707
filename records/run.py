"""Readable results of one run: named channels over time, from whatever place."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from jointplay.records.arrays import Floats as Floats
from jointplay.records.channel import Channel
from jointplay.records.peak import Peak

Columns = tuple[Floats, dict[str, Floats]]
"""(k,) times [s], and by channel (k,) values in its unit."""


class NumbersLike(Protocol):
    """An array of a certificate."""

    @property
    def values(self) -> Floats:
        """Its numbers."""


class CertificateLike(Protocol):
    """Estimated errors of one run: a document, and arrays by name.

    The arrays are those that `records.certificate` names, their columns in the order of channels.
    """

    @property
    def attributes(self) -> Mapping[str, Any]:
        """The document: "horizon" and "converged" among others."""

    @property
    def arrays(self) -> Mapping[str, NumbersLike]:
        """Times, errors, extremes, histograms."""


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
        """Names that the `joint` of an impact points to."""

    @property
    def complete(self) -> bool:
        """The run came to its end."""

    @property
    def samples(self) -> int:
        """Number of samples."""

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

    def certificate(self) -> CertificateLike | None:
        """Give the estimated errors; none before the run's end, or where none were asked for."""


def inside(time: Floats, start: float | None, stop: float | None) -> NDArray[np.bool_]:
    """Tell which times lie in start <= time <= stop [s]; None is unbounded."""
    low = -np.inf if start is None else start
    high = np.inf if stop is None else stop
    return (time >= low) & (time <= high)
