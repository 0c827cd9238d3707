"""Readable results of a study: values, status, sections and peaks of many points.

They are stored anywhere, or are in memory.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from jointplay.records.channel import Channel
from jointplay.records.peak import PeakColumns
from jointplay.records.point import Failure, has_ended
from jointplay.records.run import Floats


class StudySource(Protocol):
    """Results of one study, also of one that runs; a reader of the study store is one as it is.

    With continuation in both directions there are two points for each value: first all forward,
    then all backward.
    """

    @property
    def attributes(self) -> Mapping[str, Any]:
        """At least "job", with every default, and "scene", the scene at the first point."""

    @property
    def kind(self) -> str:
        """Kind of the job."""

    @property
    def parameters(self) -> Sequence[Channel]:
        """Parameters that differ between points; none for one point perturbed."""

    @property
    def observables(self) -> Sequence[Channel]:
        """Channels that were taken at the sections."""

    @property
    def channels(self) -> Sequence[Channel]:
        """Channels whose extremes were kept."""

    @property
    def complete(self) -> bool:
        """Every point has ended."""

    @property
    def points(self) -> int:
        """Number of points."""

    @property
    def shape(self) -> tuple[int, ...]:
        """Lengths of the axes of the points: all points, or (y, x) of a map, coarse to fine."""

    @property
    def record(self) -> int:
        """Sections that a point records at most."""

    @property
    def values(self) -> Floats:
        """(points, parameters), in the parameters' units."""

    @property
    def status(self) -> NDArray[np.uint8]:
        """(points,) codes of `PointStatus`."""

    @property
    def failures(self) -> Mapping[int, Failure]:
        """Failed points."""

    @property
    def counts(self) -> NDArray[np.int64]:
        """(points,) sections that were recorded so far."""

    def section_times(self, start: int = 0, stop: int | None = None) -> Floats:
        """Give (stop - start, record) times [s] of the sections of points, NaN-filled."""

    def sections(self, observable: str, start: int = 0, stop: int | None = None) -> Floats:
        """Give (stop - start, record) values of an observable at points, NaN-filled."""

    def peaks(self, channel: str) -> PeakColumns:
        """Give the extremes of a channel at every point."""

    @property
    def statistics(self) -> Mapping[str, Floats]:
        """(points,) by name: steps, onsets, energy_residual and the like."""

    @property
    def indicators(self) -> Mapping[str, Floats]:
        """(points,) by name: lyapunov, zero_one, period and the like."""

    @property
    def verdicts(self) -> NDArray[np.int64] | None:
        """(points,) codes into `verdict_names`, -1 where there is none yet; None: not asked for."""

    @property
    def verdict_names(self) -> Sequence[str]:
        """Names of the verdicts."""

    @property
    def reasons(self) -> Mapping[int, str]:
        """Grounds of verdicts, by point."""

    @property
    def documents(self) -> Mapping[int, Mapping[str, Any]]:
        """Results that are no numbers, by point: of a calibration what it found."""


@dataclass(frozen=True)
class StudyDataset:
    """A `StudySource` in memory.

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
        (points,) codes of `PointStatus`.
    times, section_values
        (points, record) times [s] and, by observable, values; NaN where nothing was recorded.
    extremes
        By channel.
    recorded
        (points,) sections that were recorded, where `times` has a window of them.
    grid
        Lengths of both axes, y and x, of points that are a map.
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
    reasons: Mapping[int, str] = field(default_factory=dict)
    documents: Mapping[int, Mapping[str, Any]] = field(default_factory=dict)
    recorded: NDArray[np.int64] | None = None
    grid: tuple[int, ...] = ()

    @property
    def kind(self) -> str:
        """Kind of the job."""
        return str(self.attributes["job"]["kind"])

    @property
    def points(self) -> int:
        """Number of points."""
        return len(self.status)

    @property
    def shape(self) -> tuple[int, ...]:
        """Lengths of the axes of the points."""
        return self.grid or (self.points,)

    @property
    def record(self) -> int:
        """Sections that a point records at most."""
        return int(self.times.shape[1])

    @property
    def complete(self) -> bool:
        """Every point has ended."""
        return bool(has_ended(self.status).all())

    @property
    def counts(self) -> NDArray[np.int64]:
        """(points,) sections that were recorded."""
        if self.recorded is not None:
            return self.recorded
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


FORWARD, BACKWARD = "forward", "backward"
"""Directions in which a continuation passes its values."""


def directions_of(source: StudySource) -> NDArray[np.str_] | None:
    """Return the direction of each point of a continuation that goes both ways; None: of others."""
    if source.attributes["job"].get("continuation") != "both":
        return None
    return np.where(np.arange(source.points) < source.points // 2, FORWARD, BACKWARD)
