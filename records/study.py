"""What figures and exports of a study take: values, status, sections and peaks of many points."""

from collections.abc import Mapping, Sequence
from typing import Any, Final, Protocol

import numpy as np
from numpy.typing import NDArray

from jointplay.records.run import ChannelLike, Floats

WAITING: Final = 0
RUNNING: Final = 1
DONE: Final = 2
FAILED: Final = 3
STATUS: Final = ("waiting", "running", "done", "failed")
"""What a point is doing; the code is the position."""


class FailureLike(Protocol):
    """Why a point has no results, or not all."""

    @property
    def code(self) -> str:
        """The reason for programs."""
        ...

    @property
    def detail(self) -> str:
        """The reason as a sentence."""
        ...

    @property
    def time(self) -> float:
        """Simulated time reached [s]."""
        ...


class PeakColumns(Protocol):
    """Extremes of one channel at every point, (points,) each; NaN where there are none."""

    @property
    def minimum(self) -> Floats:
        """Smallest values, in the channel's unit."""
        ...

    @property
    def minimum_time(self) -> Floats:
        """When they were reached [s]."""
        ...

    @property
    def maximum(self) -> Floats:
        """Largest values, in the channel's unit."""
        ...

    @property
    def maximum_time(self) -> Floats:
        """When they were reached [s]."""
        ...


class StudySource(Protocol):
    """Results of one study, also of one that runs; a reader of the study store is one as it is.

    With continuation in both directions there are two points for each value: first all forward,
    then all backward.
    """

    @property
    def attributes(self) -> Mapping[str, Any]:
        """At least "job", with every default, and "scene", the scene at the first point."""
        ...

    @property
    def kind(self) -> str:
        """Kind of the job."""
        ...

    @property
    def parameters(self) -> Sequence[ChannelLike]:
        """Parameters that differ between points; none for one point perturbed."""
        ...

    @property
    def observables(self) -> Sequence[ChannelLike]:
        """Channels that were taken at the sections."""
        ...

    @property
    def channels(self) -> Sequence[ChannelLike]:
        """Channels whose extremes were kept."""
        ...

    @property
    def complete(self) -> bool:
        """Every point has ended."""
        ...

    @property
    def points(self) -> int:
        """Number of points."""
        ...

    @property
    def record(self) -> int:
        """Sections that a point records at most."""
        ...

    @property
    def values(self) -> Floats:
        """(points, parameters), in the parameters' units."""
        ...

    @property
    def status(self) -> NDArray[np.uint8]:
        """(points,) codes of `STATUS`."""
        ...

    @property
    def failures(self) -> Mapping[int, FailureLike]:
        """Failed points."""
        ...

    @property
    def counts(self) -> NDArray[np.int64]:
        """(points,) sections that were recorded so far."""
        ...

    def section_times(self, start: int = 0, stop: int | None = None) -> Floats:
        """Give (stop - start, record) times [s] of the sections of points, NaN-filled."""
        ...

    def sections(self, observable: str, start: int = 0, stop: int | None = None) -> Floats:
        """Give (stop - start, record) values of an observable at points, NaN-filled."""
        ...

    def peaks(self, channel: str) -> PeakColumns:
        """Give the extremes of a channel at every point."""
        ...

    @property
    def statistics(self) -> Mapping[str, Floats]:
        """(points,) by name: steps, onsets, energy_residual and the like."""
        ...

    @property
    def indicators(self) -> Mapping[str, Floats]:
        """(points,) by name: lyapunov, zero_one, period and the like."""
        ...

    @property
    def verdicts(self) -> NDArray[np.int64] | None:
        """(points,) codes into `verdict_names`, -1 where there is none yet; None: not asked for."""
        ...

    @property
    def verdict_names(self) -> Sequence[str]:
        """Names of the verdicts."""
        ...
