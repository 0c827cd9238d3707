"""Named offsets into work arrays and dense rows: one record, which compiled loops take as `at`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numba import from_dtype
from numpy.typing import NDArray

from jointplay.solver.kernels.layout import Layout

PERIOD, TIME = 0, 1
"""Columns of a dense row: whole periods that have passed, and the time since then, s."""


@dataclass(frozen=True)
class DenseRow:
    """First column of each block of a row of dense state: what samples and sections are made of.

    Period and time come first (`PERIOD`, `TIME`).
    """

    phase: int
    """Position of each driver at local time zero, rad or m."""
    wound: int
    """Angle of each driver's whole turns before that, rad."""
    state: int
    mode: int
    """1 where a joint is in contact, 0 elsewhere."""
    impact_rate: int
    """Latched impact rate of each joint, m/s."""
    width: int

    @classmethod
    def of(cls, drivers: int, states: int, joints: int) -> DenseRow:
        """Arrange the blocks one behind the other."""
        ends = np.cumsum([TIME + 1, drivers, drivers, states, joints, joints])
        return cls(*map(int, ends))

    def times(self, rows: NDArray[np.float64], period: float) -> NDArray[np.float64]:
        """Return the simulated times (...,) of rows (..., width), s."""
        return rows[..., PERIOD] * period + rows[..., TIME]

    def states(self, rows: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the states (..., states) of rows (..., width)."""
        return rows[..., self.state : self.mode]


class Places:
    """Type of `at`: numbers of things, the dense row's columns, and first slots of blocks."""

    states: int
    ledger: int
    joints: int
    drivers: int
    rows: int
    """Channels that the scan looks at."""
    size: int
    """Slots of the work array."""
    row: DenseRow
    numbers: int
    """From here to `size`: what is constant during a period."""
    time: int
    step: int
    tried: int
    arrival: int
    stage_time: int
    theta: int
    active: int
    accept: int
    flag: int
    next_step: int
    end: int
    next_due: int
    marked: int
    stage: int
    total: int
    impulse: int
    """Each joint's impulse, at the end of `total`."""
    gap: int
    gap_rate: int
    gap_start: int
    gap_rate_start: int
    mode: int
    impact_rate: int
    before_time: int
    phase: int
    wound: int
    driver_start: int
    driver_travel: int
    contact_row: int
    """First row of the channel block that holds a normal force again, for each contact's peak."""
    channel: int
    previous: int
    highest: int
    lowest: int
    highest_time: int
    lowest_time: int
    impact_floor: int
    restart: int
    onset_time: int
    approach: int
    onset_total: int
    opened: int
    weight: int
    steps: int
    pace_at: int
    stored: int
    stored_start: int
    tangent: int
    tangent_impact_rate: int
    tangent_gap: int
    tangent_gap_rate: int
    gap_acceleration: int


COUNTS = ("states", "ledger", "joints", "drivers", "rows", "size")
OF_TANGENTS = (
    "tangent",
    "tangent_impact_rate",
    "tangent_gap",
    "tangent_gap_rate",
    "gap_acceleration",
)
"""Blocks that only a kernel with tangents has; without, nothing reads their offsets, -1."""

ROW_DTYPE = np.dtype([(name, np.int64) for name in DenseRow.__annotations__])
DTYPE = np.dtype(
    [(name, ROW_DTYPE if name == "row" else np.dtype(np.int64)) for name in Places.__annotations__]
)
PLACES = from_dtype(DTYPE)[::1]
"""How kernels take the record: an array of one, which costs Python least to pass."""


def places_of(layout: Layout, row: DenseRow, counts: Mapping[str, int]) -> NDArray[np.void]:
    """Return the record of all offsets, (1,); `counts`: numbers of states, joints and so on.

    Raises
    ------
    KeyError
        The layout lacks a slot that the loop reads.
    """
    places = np.zeros(1, DTYPE)
    places["row"] = tuple(getattr(row, name) for name in ROW_DTYPE.names or ())
    for name in DTYPE.names or ():
        if name == "size":
            places[name] = layout.size
        elif name == "impulse":
            places[name] = layout.block("total").stop - counts["joints"]
        elif name == "contact_row":
            places[name] = counts["rows"] - counts["joints"]
        elif name in COUNTS:
            places[name] = counts[name]
        elif name in OF_TANGENTS:
            places[name] = -1
        elif name != "row":
            places[name] = layout.block(name).start
    return places
