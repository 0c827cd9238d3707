"""A window of a run as it is asked for, wherever the run is."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

End = Literal["start", "stop"]


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


def wrong_end(start: float | None, stop: float | None, unit: str = " s") -> tuple[End, str] | None:
    """Return the end (start or stop) that makes a window none, and why; None: it is a window.

    Ends that are no numbers are neither before nor behind anything.
    """
    ends: tuple[tuple[End, float | None], ...] = (("start", start), ("stop", stop))
    for end, value in ends:
        if value is not None and math.isnan(value):
            return end, f"{end} is not a number; give one, or leave it out."
    if start is not None and stop is not None and start > stop:
        sentence = f"stop ({stop:g}{unit}) is before start ({start:g}{unit}); swap them."
        return "stop", sentence
    return None
