"""A point of a study while it is computed, or waits for a lane."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from jointplay.solver.kernels.loop.problem import LaneStart
from jointplay.solver.nonlinear.settling import SETTLINGS, Settling
from jointplay.solver.runs.study.indicators import RECURS, unwound

Floats = NDArray[np.float64]


@dataclass
class PointRun:
    """A point, and what it has handed out so far."""

    point: int
    chain: int
    position: int
    """In the chain."""
    start: LaneStart | None = None
    """Its neighbour's last state; none: the scene's start rule."""
    settled: int = -1
    """Periods left out, once that is known; -1 before."""
    reached: int = 0
    """Periods of the present leg's end."""
    taken: int = 0
    """Sections handed out."""
    seen: list[Floats] = field(default_factory=list)
    """States at sections, (sections, states) each, that settling or indicators still need."""
    growth: list[Floats] = field(default_factory=list)
    """Logarithms of the tangent's growth in each recorded period."""
    tallies: list[Floats] = field(default_factory=list)
    """Tallies of the job's statistics, in its order; see `solver.runs.study.window`."""
    sampled: int = 0
    """Samples that they have had."""
    settling: Settling | None = field(default=None, repr=False)

    def has_settled(self, scales: Floats, angles: NDArray[np.bool_], most: int) -> bool:
        """Look at the sections of the last leg; return whether the motion has settled."""
        found = self.settling or Settling(scales, RECURS, max(most, 1))
        if found.result is None:
            states = (
                unwound(np.concatenate(self.seen), angles)
                if self.seen
                else np.zeros((0, len(scales)))
            )
            new = states[len(found.sections) :]
            found.feed(new)
        self.settling = found
        return found.result is not None and found.result.code != SETTLINGS["unsettled"]
