"""Drives eight lanes of the recorded Adams method; onsets and openings start it anew."""

from dataclasses import dataclass

import numpy as np
from numba import float64, int64, types, void

from benchmarks.adams_step import AdamsRecorder
from jointplay.solver.kernels.cache import load
from jointplay.solver.kernels.emit.kernel import CompiledAddress, Kernel
from jointplay.solver.kernels.jit import LaneFunction, deferred, kernel
from jointplay.solver.kernels.layout import LANES
from jointplay.solver.kernels.loop.bundle import ENERGIES, Bundle, aligned_zeros

LANE_FUNCTION = types.FunctionType(void(float64[::1]))
STORED = ENERGIES.index("stored")
LANDED, MOST_TRIES, LANDED_AT_LAST = 1e-13, 12, 1e-9
"""As the driving loop of `solver.kernels.loop`: penetrations, m, and attempts."""
BEHIND, LATE = 1.02, 0.95
LONGER, NOTHING, CHANGES = 2.0, 3.0, 4.0
"""Largest multiple of a step; no share: nothing to redo; a contact begins or ends with the step."""
NAMES = (
    "time", "end", "active", "flag", "accept", "tried", "step", "next_step", "order", "memory",
    "starting", "new_memory", "since", "landing", "tries", "gap0", "mode0", "impact_rate0",
    "impact_floor0", "restart0",
)  # fmt: skip
(
    TIME, END, ACTIVE, FLAG, ACCEPT, TRIED, STEP, NEXT_STEP, ORDER, MEMORY, STARTING, NEW_MEMORY,
    SINCE, LANDING, TRIES, GAP, MODE, RATE, FLOOR, RESTART,
) = range(len(NAMES))  # fmt: skip


@kernel()
def root(start: float, start_rate: float, gap: float, rate: float) -> float:
    """Return where in 0..1 the cubic through both ends passes zero; rates are those a step."""
    low, high = 0.0, 1.0
    for _ in range(50):
        x = 0.5 * (low + high)
        rest = 1.0 - x
        value = rest * rest * ((1.0 + 2.0 * x) * start + x * start_rate)
        value += x * x * ((3.0 - 2.0 * x) * gap - rest * rate)
        if (value > 0.0) == (gap > 0.0):
            high = x
        else:
            low = x
    return high


@kernel()
def until_open(tried: float, start: float, start_rate: float, gap: float, rate: float) -> float:
    """Return the share of the step that ends behind the opening of a contact; or what to do."""
    if gap > 0.0:
        return NOTHING
    if start > LANDED:
        share = root(start, start_rate * tried, gap, rate * tried)
        if share < LATE:
            return BEHIND * share
    return CHANGES if rate < 0.0 else NOTHING


@kernel()
def until_landed(tried: float, gap: float, rate: float, last: bool) -> float:
    """Return the share (above 1: multiple) of the step that ends on an onset; or what to do."""
    if abs(gap) <= LANDED or (last and abs(gap) <= LANDED_AT_LAST):
        return CHANGES
    return min(1.0 - gap / (rate * tried), LONGER) if rate > 0.0 else LONGER


@kernel()
def until_top(tried: float, start: float, start_rate: float, gap: float, rate: float) -> float:
    """Return the share of the step that ends where a gap comes nearest, if it seems to close."""
    if start_rate <= 0.0 or rate >= 0.0:
        return NOTHING
    turn = start_rate / (start_rate - rate)
    rest = 1.0 - turn
    top = rest * rest * ((1.0 + 2.0 * turn) * start + turn * start_rate * tried)
    top += turn * turn * ((3.0 - 2.0 * turn) * gap - rest * rate * tried)
    return turn if top > 0.0 and 0.1 < turn < 0.9 else NOTHING


@kernel()
def attend(work: np.ndarray, at: np.ndarray, lane: int, joints: int) -> int:
    """Decide on a flagged lane: the joint whose contact begins or ends with the step, or -1.

    A step that should end elsewhere is to be redone.
    """
    if work[at[ACCEPT], lane] == 0.0:
        work[at[LANDING], lane] = 0.0
        return -1
    tried = work[at[TRIED], lane]
    soonest, target, change = NOTHING, 0, -1
    for j in range(joints):
        gap, rate = work[at[GAP] + 4 * j, lane], work[at[GAP] + 4 * j + 1, lane]
        start, start_rate = work[at[GAP] + 4 * j + 2, lane], work[at[GAP] + 4 * j + 3, lane]
        aim = 0
        if work[at[MODE] + j, lane] > 0.0:
            share = until_open(tried, start, start_rate, gap, rate)
        elif work[at[LANDING], lane] == j + 1.0:
            work[at[TRIES], lane] += 1.0
            share, aim = until_landed(tried, gap, rate, work[at[TRIES], lane] > MOST_TRIES), j + 1
        elif gap > 0.0:
            share, aim = root(start, start_rate * tried, gap, rate * tried), j + 1
        else:
            share = until_top(tried, start, start_rate, gap, rate)
        if share == CHANGES:
            change = j
        elif share < soonest:
            soonest, target = share, aim
    if soonest == NOTHING:
        work[at[LANDING], lane] = 0.0
        return change
    work[at[ACCEPT], lane], work[at[NEXT_STEP], lane] = 0.0, soonest * tried
    work[at[MEMORY], lane] = work[at[ORDER], lane]
    if work[at[LANDING], lane] != target:
        work[at[LANDING], lane], work[at[TRIES], lane] = target, 0.0
    return -1


@kernel()
def begin_anew(work: np.ndarray, at: np.ndarray, lane: int, j: int) -> None:
    """Let the contact of joint j begin or end where a step did, and start at order 1."""
    if work[at[MODE] + j, lane] > 0.0:
        work[at[MODE] + j, lane] = 0.0
    else:
        rate = max(work[at[GAP] + 4 * j + 1, lane], work[at[FLOOR] + j, lane])
        work[at[MODE] + j, lane], work[at[RATE] + j, lane] = 1.0, rate
        first = work[at[RESTART] + j, lane] / rate
        work[at[STEP], lane] = min(work[at[STEP], lane], first)
    work[at[ORDER], lane], work[at[STARTING], lane], work[at[SINCE], lane] = 1.0, 1.0, 0.0


@deferred(int64(*[LANE_FUNCTION] * 5, float64[:, ::1], float64[::1], int64[::1], int64, int64))
def run(
    right_hand_side: LaneFunction,
    predict: LaneFunction,
    correct: LaneFunction,
    judge: LaneFunction,
    take: LaneFunction,
    work: np.ndarray,
    flat: np.ndarray,
    at: np.ndarray,
    joints: int,
    budget: int,
) -> int:
    """Advance all lanes to their ends, in at most `budget` attempts; how many were made."""
    changes = np.full(LANES, -1)
    for made in range(budget):
        predict(flat)
        right_hand_side(flat)
        correct(flat)
        right_hand_side(flat)
        judge(flat)
        flags = 0.0
        for lane in range(LANES):
            flags += work[at[FLAG], lane]
        if flags == 0.0:
            take(flat)
            continue
        for lane in range(LANES):
            changes[lane] = -1
            if work[at[FLAG], lane] > 0.0:
                changes[lane] = attend(work, at, lane, joints)
        take(flat)
        running = 0.0
        for lane in range(LANES):
            if changes[lane] >= 0:
                begin_anew(work, at, lane, changes[lane])
            if work[at[TIME], lane] >= work[at[END], lane]:
                work[at[ACTIVE], lane] = 0.0
            running += work[at[ACTIVE], lane]
        if running == 0.0:
            return made
    return budget


@dataclass(frozen=True)
class Adams:
    """The compiled method of one kernel."""

    kernel: Kernel
    recorder: AdamsRecorder
    functions: tuple[CompiledAddress, ...]
    places: np.ndarray

    def begin(self, bundle: Bundle) -> np.ndarray:
        """Return the work array (slots, LANES) of a bundle's runs, which are about to start."""
        work = aligned_zeros(self.recorder.layout.size * LANES).reshape(-1, LANES)
        work[: self.kernel.layout.size] = bundle.work.reshape(-1, LANES)
        at, states = self.recorder.layout, self.kernel.states
        for i in range(self.recorder.highest + 1):
            work[at[f"spacing{i}"]], work[at[f"inverse{i}"]] = 1.0, 1.0
        for s in range(states):
            work[at[f"difference0_{s}"]] = work[at[f"k1_{s}"]]
        for i in range(self.recorder.ledger):
            work[at[f"difference0_{states + i}"]] = work[at[f"kledger1_{i}"]]
        work[at["order"]] = work[at["starting"]] = 1.0
        return work

    def finish(self, bundle: Bundle, work: np.ndarray) -> None:
        """Run to the end, and leave states and ledgers in the bundle.

        Raises
        ------
        RuntimeError
            It does not get there.
        """
        joints, budget = len(self.kernel.play), 10_000_000
        if run(*self.functions, work, work.reshape(-1), self.places, joints, budget) == budget:
            raise RuntimeError("the Adams method did not reach the end")
        bundle.work[:] = work[: self.kernel.layout.size].reshape(-1)
        for lane in range(LANES):  # what contacts store is not lost
            stored = bundle.energy(lane)[STORED] - bundle.first_energy[STORED, lane]
            bundle.table("total0")[0, lane] -= stored


def adams_of(kernel: Kernel, highest: int) -> Adams:
    """Return the method up to an order, compiled; seconds when it is not cached."""
    recorder = AdamsRecorder(kernel, highest)
    module = load(recorder.source())
    own = tuple(
        CompiledAddress(getattr(module, name)) for name in ("predict", "correct", "judge", "take")
    )
    right_hand_side = CompiledAddress(kernel.module.right_hand_side)
    places = np.array([recorder.layout[name] for name in NAMES], dtype=np.int64)
    return Adams(kernel, recorder, (right_hand_side, *own), places)
