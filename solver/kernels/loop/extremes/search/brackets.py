"""Brackets of steps in which extremes are sought, and room for all that one search has at once."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from jointplay.solver.kernels.layout import INSTANTS

SHARP = 2e-7
"""Share of a channel's range up to now to which its extremes are sought."""
TINY = 1e-300
"""Added to what may be zero, so that it can divide."""
NODES = 5
MIDDLE, LAST = 2, NODES - 1
MOST_ROUNDS = 18
"""Two looks of three narrow a bracket to a third at least."""
MOST = 20
"""Brackets of a channel: eight instants, twice; or five nodes of four parts of two steps."""


class Bracket:
    """Type of a bracket: even nodes of the step before or of this one, about an extreme."""

    row: int
    """Channel."""
    sense: float
    """1: a maximum is sought; -1: a minimum."""
    step: int
    """1: in this step; 0: in the one before."""
    start: float
    """First node, as a share of that step."""
    spacing: float
    """From one node to the next."""
    values: NDArray[np.float64]
    """(NODES,) of the channel at the nodes."""
    best: int
    """Node about which the extreme is sought: no value beside it is beyond its own."""
    abscissa: float
    """Where `extreme` foretells it, in spacings from the first node."""
    value: float
    error: float
    bent: float
    """Its value, a bound on that value's error, and the second difference there."""
    column: int
    """Instant of a look that is there; -1: it is at a node."""
    rounds: int
    """Number of looks at it; `MOST_ROUNDS`: nothing is left to do."""
    at_end: int
    """1 while nobody looked next to a best value at an end of the step."""
    narrowing: float
    """Share of the spacing to which a look where the extreme is foretold narrows it next; 0 after
    such a look missed it."""
    seen: NDArray[np.float64]
    """(INSTANTS,) values of the last look, in the order of time."""


SHAPES = {"values": (NODES,), "seen": (INSTANTS,)}
DTYPE = np.dtype(
    [
        (name, np.int64 if kind == "int" else np.float64, SHAPES.get(name, ()))
        for name, kind in Bracket.__annotations__.items()
    ]
)


def room_for(channels: int) -> NDArray[Any]:
    """Return room for the brackets of so many channels, and for what opens one more."""
    return np.zeros(MOST * channels + 1, DTYPE)
