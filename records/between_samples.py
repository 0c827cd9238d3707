"""Values and extremes of a run between its samples, whoever computes them."""

from collections.abc import Sequence
from typing import Protocol

from jointplay.records.arrays import Floats


class Found(Protocol):
    """An answer, or a sentence that says why there is none."""

    @property
    def values(self) -> Floats | None:
        """Numbers; None: refused."""

    @property
    def refused(self) -> str:
        """A sentence; empty where there are numbers."""


class BetweenSamples(Protocol):
    """The trajectory of a run, read at any time."""

    @property
    def reached(self) -> float:
        """Time up to which it is known, s."""

    @property
    def covered(self) -> float:
        """Time up to which values at any instant are known, s; from what is stored alone."""

    def values(self, names: Sequence[str], times: Floats) -> Found:
        """Give channels (m, names) at ascending times (m,), s."""

    def edges(self, start: float, stop: float, points: int) -> Floats:
        """Give edges of at most `points` spans of a window, s, whose extremes are known exactly."""

    def extremes(self, names: Sequence[str], edges: Floats) -> Found:
        """Give (bins, names, 4) between edges, s: lowest, its time, highest, its time."""

    def works(self, start: float, stop: float) -> Found:
        """Give (k, 5) times of a window, s, and works since its start, J; see `records.works`."""

    def instants(self, start: float, stop: float, most: int) -> Floats | None:
        """Give times, s, at which a path in a plane looks as it is; None: more than `most`."""
