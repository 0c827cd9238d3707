"""A window of a run as it is asked for, wherever the run is."""

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class WindowQuery:
    """Channels in a window of time: samples, unless `points` or `step` say otherwise."""

    channels: Sequence[str] | None = None
    """Names or globs; all if None."""
    start: float | None = None
    """s, included; unbounded if None."""
    stop: float | None = None
    """s, included; unbounded if None."""
    points: int | None = None
    """Pairs of smallest and largest values, each of an equal span."""
    step: float | None = None
    """Time between instants, s, at which values are computed from the steps of the run."""

    @property
    def of_samples(self) -> bool:
        """Whether samples are asked for, as they are stored."""
        return self.points is None and self.step is None
