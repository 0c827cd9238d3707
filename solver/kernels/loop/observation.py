"""Channels of rows of dense state: forces and accelerations evaluated at the samples themselves."""

from __future__ import annotations

import numpy as np
from numba import float64, int64, types, void

from jointplay.solver.kernels.jit import LaneFunction, deferred
from jointplay.solver.kernels.layout import LANES
from jointplay.solver.kernels.slots import Slot

LANE_FUNCTION = types.FunctionType(void(float64[::1]))


@deferred(
    void(
        LANE_FUNCTION,
        LANE_FUNCTION,
        LANE_FUNCTION,
        int64[::1],
        float64[::1],
        float64[::1],
        int64,
        float64[:, ::1],
        int64[::1],
        float64[:, ::1],
    )
)
def observe_rows(
    right_hand_side: LaneFunction,
    observe: LaneFunction,
    observe_rest: LaneFunction,
    slots: np.ndarray,
    work: np.ndarray,
    spare: np.ndarray,
    lane: int,
    rows: np.ndarray,
    columns: np.ndarray,
    out: np.ndarray,
) -> None:
    """Evaluate channels of lane lane at rows of dense state, eight at a time.

    rows : (count, width) as `kernels.loop.rows.write_row` wrote them. columns : (channels,) rows
    of the channel block. out : (count, channels).
    """
    for s in range(slots[Slot.NUMBERS], slots[Slot.SIZE]):
        value = work[s * LANES + lane]
        for i in range(LANES):
            spare[s * LANES + i] = value
    for first in range(0, len(rows), LANES):
        count = min(LANES, len(rows) - first)
        for i in range(LANES):
            row = rows[first + min(i, count - 1)]
            spare[slots[Slot.STAGE_TIME] * LANES + i] = row[1]
            at = 2
            for k in range(2 * slots[Slot.DRIVERS]):
                spare[(slots[Slot.PHASE] + k) * LANES + i] = row[at + k]
            at += 2 * slots[Slot.DRIVERS]
            for k in range(slots[Slot.STATES]):
                spare[(slots[Slot.STAGE] + k) * LANES + i] = row[at + k]
            at += slots[Slot.STATES]
            for k in range(slots[Slot.JOINTS]):
                spare[(slots[Slot.MODE] + k) * LANES + i] = row[at + 2 * k]
                spare[(slots[Slot.IMPACT_RATE] + k) * LANES + i] = row[at + 2 * k + 1]
        right_hand_side(spare)
        observe(spare)
        observe_rest(spare)
        for i in range(count):
            for c in range(len(columns)):
                out[first + i, c] = spare[(slots[Slot.CHANNEL] + columns[c]) * LANES + i]
