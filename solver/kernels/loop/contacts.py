"""Contacts of a lane: landing on an onset, latching the impact rate, the end of a contact."""

from __future__ import annotations

import numpy as np

from jointplay.solver.kernels.emit.judging import LANDED
from jointplay.solver.kernels.jit import LaneFunction, kernel
from jointplay.solver.kernels.layout import LANES
from jointplay.solver.kernels.loop.onset import NO_ONSET, first_onset
from jointplay.solver.kernels.loop.periods import stop
from jointplay.solver.kernels.loop.state import Counter, Status
from jointplay.solver.kernels.slots import Slot

MOST_LANDINGS = 12
"""Attempts to land on one onset before it is approached in shorter steps."""
MOST_APPROACHES = 30
"""Times that the step is shortened to a quarter for one onset."""
CAUTIOUS = 0.3
"""Of the size that the estimate asks for: a rejected step that starts where contact does. The force
grows as a broken power of time there, and the estimate sees about a third of the error."""
LANDED_AT_LAST = 1e-9
"""Penetration, m, that is taken after the last attempt: an onset so flat that rounding hides it."""


@kernel()
def land(
    lane: int,
    slots: np.ndarray,
    work: np.ndarray,
    spare: np.ndarray,
    counters: np.ndarray,
    gaps_within: LaneFunction,
) -> bool:
    """Whether this step may be taken: it has no onset inside, or ends on one.

    Otherwise the step is to be redone, shortened to the first onset inside it.
    """
    tried = work[slots[Slot.TRIED] * LANES + lane]
    target = counters[Counter.LANDING, lane]
    onset = NO_ONSET
    joint = -1
    overshot = False
    for j in range(slots[Slot.JOINTS]):
        if work[(slots[Slot.MODE] + j) * LANES + lane] > 0.0:
            continue
        gap = work[(slots[Slot.GAP] + 4 * j) * LANES + lane]
        if gap > 0.0 and work[(slots[Slot.RESTART] + j) * LANES + lane] == np.inf:
            counters[Counter.LANDING, lane] = j  # the step is fixed: contact begins where it ends
            return True
        if j == target and abs(gap) <= LANDED:
            continue
        if j == target and gap > 0.0:
            overshot = True  # it has its onset here; when does not matter, if no other has one
            continue
        found = first_onset(j, lane, slots, work, spare, gaps_within)
        if found < onset:
            onset, joint = found, j
    if overshot:
        found = -1.0
        if joint >= 0:
            found = first_onset(target, lane, slots, work, spare, gaps_within)
        if found < onset:
            onset, joint = found, target
    if target >= 0:
        gap = work[(slots[Slot.GAP] + 4 * target) * LANES + lane]
        rate = work[(slots[Slot.GAP] + 4 * target + 1) * LANES + lane]
        last = counters[Counter.LANDINGS, lane] >= MOST_LANDINGS
        near = abs(gap) <= LANDED or (last and abs(gap) <= LANDED_AT_LAST)
        if near and (joint < 0 or joint == target):
            return True
        if last:  # steps so long that the end of one hardly tells of the end of another
            counters[Counter.LANDING, lane] = -1
            counters[Counter.LANDINGS, lane] += 1
            work[slots[Slot.NEXT_STEP] * LANES + lane] = 0.25 * tried
            if counters[Counter.LANDINGS, lane] > MOST_LANDINGS + MOST_APPROACHES:
                stop(lane, Status.ONSET_LOST, slots, work, counters)
            return False
        if gap < 0.0 and rate <= 0.0 and joint < 0:
            counters[Counter.LANDING, lane] = -1  # it only came near, and is on its way back
            return True
        if joint < 0 or joint == target:
            # Newton on the landing itself: the redone step differs from the dense output
            joint = target
            onset = 1.0
            if rate > 0.0:
                onset = 1.0 - gap / (rate * tried)
            onset = min(max(onset, 0.1), 2.0)
    if joint < 0:
        return True
    counters[Counter.LANDING, lane] = joint
    counters[Counter.LANDINGS, lane] += 1
    work[slots[Slot.NEXT_STEP] * LANES + lane] = onset * tried
    return False


@kernel()
def begin_contact(j: int, now: float, lane: int, slots: np.ndarray, work: np.ndarray) -> None:
    """Latch the impact rate of joint j, once per onset, and restart with a small step."""
    rate = work[(slots[Slot.GAP] + 4 * j + 1) * LANES + lane]
    floored = max(rate, work[(slots[Slot.IMPACT_FLOOR] + j) * LANES + lane])
    work[(slots[Slot.MODE] + j) * LANES + lane] = 1.0
    work[(slots[Slot.IMPACT_RATE] + j) * LANES + lane] = floored
    work[(slots[Slot.ONSET_TIME] + j) * LANES + lane] = now
    work[(slots[Slot.APPROACH] + j) * LANES + lane] = rate
    impulse = slots[Slot.TOTAL] + slots[Slot.LEDGER] - slots[Slot.JOINTS] + j
    work[(slots[Slot.ONSET_TOTAL] + j) * LANES + lane] = work[impulse * LANES + lane]
    work[(slots[Slot.HIGHEST] + slots[Slot.ROWS] - slots[Slot.JOINTS] + j) * LANES + lane] = 0.0
    first = work[(slots[Slot.RESTART] + j) * LANES + lane] / floored
    work[slots[Slot.STEP] * LANES + lane] = min(work[slots[Slot.STEP] * LANES + lane], first)


@kernel()
def end_contact(
    j: int,
    now: float,
    lane: int,
    slots: np.ndarray,
    work: np.ndarray,
    counters: np.ndarray,
    impact_rows: np.ndarray,
) -> None:
    """Write the contact of joint j that ends now (not a number: it lasts beyond the run)."""
    row = impact_rows[lane, counters[Counter.IMPACT_ROWS, lane]]
    impulse = slots[Slot.TOTAL] + slots[Slot.LEDGER] - slots[Slot.JOINTS] + j
    row[0] = j
    row[1] = work[(slots[Slot.ONSET_TIME] + j) * LANES + lane]
    row[2] = now
    row[3] = work[(slots[Slot.APPROACH] + j) * LANES + lane]
    highest = work[(slots[Slot.HIGHEST] + slots[Slot.ROWS] - slots[Slot.JOINTS] + j) * LANES + lane]
    row[4] = max(
        highest,
        work[(slots[Slot.PREVIOUS] + slots[Slot.ROWS] - slots[Slot.JOINTS] + j) * LANES + lane],
    )
    row[5] = work[impulse * LANES + lane] - work[(slots[Slot.ONSET_TOTAL] + j) * LANES + lane]
    counters[Counter.IMPACT_ROWS, lane] += 1


@kernel()
def is_touching(lane: int, slots: np.ndarray, work: np.ndarray) -> bool:
    """Whether a contact begins where this step does."""
    found = False
    for j in range(slots[Slot.JOINTS]):
        depth = abs(work[(slots[Slot.GAP] + 4 * j + 2) * LANES + lane])
        found |= work[(slots[Slot.MODE] + j) * LANES + lane] > 0.0 and depth <= LANDED
    return found
