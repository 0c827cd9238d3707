"""Results of a study in memory, to be filled from what the service sends."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from jointplay.records.channel import Channel
from jointplay.records.peak import PeakColumns
from jointplay.records.point import Failure, PointStatus
from jointplay.records.run import Floats


@dataclass(frozen=True)
class StudyDataset:
    """A `records.study.StudySource` in memory.

    Parameters
    ----------
    attributes
        Root attributes of the store; figures look at "job" and "scene".
    parameters, observables, channels
        What there is; `section_values` and `extremes` may hold fewer, if the rest is never asked
        for.
    values
        (points, parameters).
    status
        (points,) codes of `records.study.STATUS`.
    times, section_values
        (points, record) times [s] and, by observable, values; NaN where nothing was recorded.
    extremes
        By channel.
    """

    attributes: Mapping[str, Any]
    parameters: Sequence[Channel]
    values: Floats
    status: NDArray[np.uint8]
    observables: Sequence[Channel] = ()
    channels: Sequence[Channel] = ()
    times: Floats = field(default_factory=lambda: np.empty((0, 0)))
    section_values: Mapping[str, Floats] = field(default_factory=dict)
    extremes: Mapping[str, PeakColumns] = field(default_factory=dict)
    failures: Mapping[int, Failure] = field(default_factory=dict)
    statistics: Mapping[str, Floats] = field(default_factory=dict)
    indicators: Mapping[str, Floats] = field(default_factory=dict)
    verdicts: NDArray[np.int64] | None = None
    verdict_names: Sequence[str] = ()

    @property
    def kind(self) -> str:
        """Kind of the job."""
        return str(self.attributes["job"]["kind"])

    @property
    def points(self) -> int:
        """Number of points."""
        return len(self.status)

    @property
    def record(self) -> int:
        """Sections that a point records at most."""
        return int(self.times.shape[1])

    @property
    def complete(self) -> bool:
        """Every point has ended."""
        return bool(np.isin(self.status, (PointStatus.done, PointStatus.failed)).all())

    @property
    def counts(self) -> NDArray[np.int64]:
        """(points,) sections that were recorded."""
        return np.asarray(np.isfinite(self.times).sum(axis=1), dtype=np.int64)

    def section_times(self, start: int = 0, stop: int | None = None) -> Floats:
        """Give the times [s] of the sections of points."""
        return self.times[start:stop]

    def sections(self, observable: str, start: int = 0, stop: int | None = None) -> Floats:
        """Give an observable at the sections of points."""
        return self.section_values[observable][start:stop]

    def peaks(self, channel: str) -> PeakColumns:
        """Give the extremes of a channel at every point."""
        return self.extremes[channel]
