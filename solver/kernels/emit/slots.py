"""Named slots of work arrays and dense rows: one structure, which compiled loops take as `at`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from jointplay.records.arrays import Floats
from jointplay.solver.kernels.layout import Layout

PERIOD, TIME = 0, 1
"""Columns of a dense row: whole periods that have passed, and the time since then, s."""
LENGTH = 2
"""Column of a row of a step, s."""


@dataclass(frozen=True)
class DenseRow:
    """First column of each block of a row of dense state: what samples and sections are made of.

    Period and time come first (`PERIOD`, `TIME`).
    """

    phase: int
    """Each clock at local time zero; of a steady driver its position, rad or m, else s."""
    wound: int
    """Whole turns of each clock before that, in its unit."""
    state: int
    mode: int
    """1 where a pair is in contact, 0 elsewhere."""
    impact_rate: int
    """Latched impact rate of each pair, m/s."""
    width: int

    @classmethod
    def of(cls, clocks: int, states: int, pairs: int) -> DenseRow:
        """Arrange the blocks one behind the other."""
        ends = np.cumsum([TIME + 1, clocks, clocks, states, pairs, pairs])
        return cls(*map(int, ends))

    def times(self, rows: Floats, period: float) -> Floats:
        """Return the simulated times (...,) of rows (..., width), s; of steps, where they begin."""
        return rows[..., PERIOD] * period + rows[..., TIME]

    def states(self, rows: Floats) -> Floats:
        """Return the states (..., states) of rows (..., width)."""
        return rows[..., self.state : self.mode]


@dataclass(frozen=True)
class StepRow:
    """First column of each block of a row of an accepted step: all that making it again needs.

    Period and time of its start come first, as in a dense row, then its length, s.
    """

    coordinates: int
    """Number of coordinates, whose slopes are their speeds."""
    state: int
    slope: int
    """Slopes at the start of all states but the coordinates.

    Kept, for the step before evaluated them: before a contact began, or a period.
    """
    mode: int
    impact_rate: int
    width: int

    @classmethod
    def of(cls, coordinates: int, states: int, pairs: int) -> StepRow:
        """Arrange the blocks one behind the other."""
        ends = np.cumsum([LENGTH + 1, states, states - coordinates, pairs, pairs])
        return cls(coordinates, *map(int, ends))


COUNTS = ("states", "inner_states", "ledger", "pairs", "clocks", "rows", "watched_closely")
"""Numbers of states, states of friction's own, terms of the ledger, contact pairs, clocks,
scanned channels, and whether steps of contacts are looked at inside."""
_SLOTS = """
numbers time step tried arrival stage_time theta active accept flag next_step end next_due marked
stage total penetration penetration_rate penetration_start penetration_rate_start mode impact_rate
before_time phase wound slip slip_rate slip_start slip_rate_start eccentricity eccentricity_start
before_step change inner lever slip_row penetration_row normal_row inner_row bend y k1_ slope
largest_step known_range rounding alike bent clock_start clock_travel clock_turn channel previous
highest lowest highest_time lowest_time impact_floor restart onset_time approach_rate onset_total
opened abrupt weight steps pace_at look_at look_beyond looked_into swing may_look may_pass_bend
looks_inside rough_until stored stored_start kledger1_ resumed
"""
SLOTS = tuple(_SLOTS.split())
"""Blocks of the work array that loops read or write; see the `allocate` functions beside this."""
KEEPS_LEDGER = "keeps_ledger"
"""Slot that is positive in lanes whose works and impulses are wanted."""
OF_TANGENTS = (
    "tangent",
    "tangent_impact_rate",
    "tangent_penetration",
    "tangent_penetration_rate",
    "penetration_acceleration",
)
"""Blocks that only a kernel with tangents has; without, nothing reads their offsets, -1."""
DERIVED = ("size", "impulse", "power", "contact_row")
"""Slots of the work array; where `total` has the pairs' impulses; powers of the ledger's terms at
the stage; first row of the channel block that has a normal force again, for the peak of each
contact."""

ROW_DTYPE = np.dtype([(name, np.int64) for name in DenseRow.__annotations__])
STEP_DTYPE = np.dtype([(name, np.int64) for name in StepRow.__annotations__])
NAMES = (*COUNTS, *SLOTS, *OF_TANGENTS, *DERIVED)
DTYPE = np.dtype(
    [*((name, np.int64) for name in NAMES), ("row", ROW_DTYPE), ("step_row", STEP_DTYPE)]
)
Slots = Any
"""Type of `at` in loops: a structure of `DTYPE`, ``work[at.mode + j, lane]``."""


def slots_of(
    layout: Layout, row: DenseRow, step_row: StepRow, counts: Mapping[str, int]
) -> NDArray[np.void]:
    """Return the structure of all slots, (1,); `counts`: numbers of states, pairs and so on.

    Raises
    ------
    KeyError
        The layout lacks a slot that the loop reads.
    """
    slots = np.zeros(1, DTYPE)
    found = dict(counts) | {name: layout.block(name).start for name in SLOTS}
    found |= dict.fromkeys(OF_TANGENTS, -1) | {"size": layout.size}
    found["impulse"] = layout.block("total").stop - counts["pairs"]
    found["power"] = layout.block("ledger").start
    found["contact_row"] = counts["rows"] - counts["pairs"]
    for name in NAMES:
        slots[name] = found[name]
    for name, kind in (("row", row), ("step_row", step_row)):
        slots[name] = tuple(getattr(kind, column) for column in type(kind).__annotations__)
    return slots
