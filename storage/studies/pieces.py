"""What a study's store takes: the pieces that a computation hands out, as far as it looks at them.

Protocols, because the store does not know the solver.
"""

from collections.abc import Mapping, Sequence
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


class Rows(Protocol):
    """Sections of one point that became known."""

    @property
    def point(self) -> int:
        """Index of the point in the study."""
        ...

    @property
    def first(self) -> int:
        """Index of the first row among the point's sections."""
        ...

    @property
    def time(self) -> Floats:
        """(k,) s."""
        ...

    @property
    def values(self) -> Floats:
        """(k, observables)."""
        ...


class End(Protocol):
    """How one point ended."""

    @property
    def point(self) -> int:
        """Index of the point in the study."""
        ...

    @property
    def code(self) -> str:
        """Empty when it came to its end, else the failure's code."""
        ...

    @property
    def detail(self) -> str:
        """The failure as a sentence."""
        ...

    @property
    def time(self) -> float:
        """Simulated time reached, s."""
        ...

    @property
    def peaks(self) -> Floats:
        """(channels, 4): minimum, its time, maximum, its time."""
        ...

    @property
    def statistics(self) -> Mapping[str, float]:
        """Numbers by name; the same names at every point that came to its end."""
        ...

    @property
    def indicators(self) -> Mapping[str, float]:
        """The same for what says regular from chaotic."""
        ...


class Piece(Protocol):
    """What became known since the last piece."""

    @property
    def started(self) -> Sequence[int]:
        """Points whose computing began."""
        ...

    @property
    def rows(self) -> Sequence[Rows]:
        """New sections; those of a point continue without gaps."""
        ...

    @property
    def ended(self) -> Sequence[End]:
        """Points that ended, each once, after all their sections."""
        ...
