"""The event of a section at which a channel crosses a value."""

import math
from collections.abc import Mapping
from typing import Any

from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.kernels.loop.runs import SectionKind
from jointplay.solver.lanes.problem import Event

ANGLES = (".theta", ".angle")
"""Ends of the names of channels that are angles: of bodies, and between two bodies."""


def crossing_event(kernel: Kernel, section: Mapping[str, Any], not_before: float = 0.0) -> Event:
    """Return the event of a section as a job has it: with channel, value and direction.

    `not_before` : time from which crossings count, s.
    """
    name, value = section["channel"], float(section["value"])
    sense = 1.0 if section["direction"] == "up" else -1.0
    if name in kernel.rows.multiples:
        name, factor, offset = kernel.rows.multiples[name]
        value, sense = (value - offset) / factor, sense if factor > 0.0 else -sense
    row = kernel.rows.index(name)
    turn = 2.0 * math.pi if name.endswith(ANGLES) else 0.0
    return Event(SectionKind.CROSSING, row, value, sense, turn, not_before)
