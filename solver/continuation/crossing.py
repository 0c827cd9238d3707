"""Sections of a mechanism that nothing drives: where a channel crosses a value in one direction.

A run begins at a section, or beside it: its own motion carries it there. So the map from section to
section takes whole states, and none of them has to depend on the others. Its derivative along the
motion is 0, in the place of the multiplier 1 that a map over a fixed time has; the others are those
of the orbit (Kuznetsov 2004, Elements of Applied Bifurcation Theory, 3rd ed., section 1.5).
"""

from dataclasses import dataclass, replace

from jointplay.records.arrays import Floats
from jointplay.solver.kernels.loop.runs import SECTIONS
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import Event

EARLIEST = 1e-3
"""Time before which a run is still at the section where it began, in that between two crossings:
a section's state is off by rounding, that of a run beside it by 4e-5 of what the states move."""
PATIENCE = 20
"""Times between two crossings that the motion at the start may take for one, and runs later."""


@dataclass(frozen=True)
class Crossing:
    """The event that makes a section."""

    event: Event
    interval: float
    """Time between two crossings, s: of the motion at the start, or a guess before that is known.
    """

    def behind(self, start: float = 0.0) -> Event:
        """Return the event of the next crossings behind a time, s; from 0 that of the start."""
        return replace(self.event, not_before=start or EARLIEST * self.interval)


class Crossings:
    """Collects the sections of a bundle's lanes while it advances."""

    def __init__(self, bundle: Bundle, lanes: int) -> None:
        """Begin with none."""
        self._bundle = bundle
        self.rows: list[list[Floats]] = [[] for _ in range(lanes)]
        """Dense rows of each lane, (width,)."""

    def collect(self) -> None:
        """Take what the bundle has handed out in its last call."""
        for lane, rows in enumerate(self.rows):
            rows += list(self._bundle.rows(SECTIONS, lane).copy())

    def time(self, lane: int, number: int) -> float:
        """Return the time of a lane's crossing, s; where it came to none, of its end."""
        rows = self.rows[lane]
        at = rows[number - 1] if len(rows) >= number else self._bundle.lane(lane).row()[0]
        return float(self._bundle.times(lane, at))

    def lack(self, lane: int, wanted: int) -> str:
        """Return a clause about a lane that did not cross so often; empty: it did."""
        count = len(self.rows[lane])
        if count >= wanted:
            return ""
        until = self._bundle.runs["duration"][lane]
        return f"a run beside it is at the section {count} of {wanted} times in {until:.3g} s"
