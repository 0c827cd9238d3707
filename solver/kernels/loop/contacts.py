"""Contacts of a lane: landing on an onset, latching the impact rate, the end of a contact."""

import numpy as np

from jointplay.solver.kernels.emit.judging import LANDED
from jointplay.solver.kernels.jit import inner_kernel
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop import generated
from jointplay.solver.kernels.loop.onset import NO_ONSET, first_onset, newton_step
from jointplay.solver.kernels.loop.periods import stop
from jointplay.solver.kernels.loop.runs import NO_PAIR, Status
from jointplay.solver.kernels.loop.step import Step

MOST_LANDINGS = 12
"""Attempts to land on one onset before it is approached in shorter steps."""
MOST_SHORTENINGS = 30
"""Times that the step is shortened to a quarter for one onset."""
CAUTIOUS = 0.3
"""Share of the size that the estimate asks for, of a rejected step that starts where contact does.
The force grows as a broken power of time there; the estimate sees about a third of the error."""
LANDED_AT_LAST = 1e-9
"""Penetration, m, that is taken after the last attempt: an onset so flat that rounding hides it."""


@inner_kernel()
def land(s: Step) -> bool:
    """Whether this step may be taken: no contact begins inside it, but perhaps at its end.

    1. Find the pair whose contact begins first inside the step, and when (`earliest_onset`).
    2. Redo the step so that it ends there. The redone step differs from the dense output that
       gave the time, so its end misses the onset by a little: from here on the pair is the target.
    3. Take the step once the target's penetration at its end is as good as zero (`LANDED`);
       until then move the end by Newton's rule (`newton_step`), unless another contact begins
       before: then that is the target.
    4. After `MOST_LANDINGS` redone steps, approach in steps of a quarter (`shorten`); after
       `MOST_SHORTENINGS` of them the run has failed.

    A target that only came near, and is on its way back, is dropped. Where steps are fixed,
    contact begins at the end of the step that it began in.
    """
    lane, run, at, work = s.lane, s.run, s.at, s.work
    at_end = closed_in_fixed_step(s)
    if at_end != NO_PAIR:
        run.landing = at_end
        return True
    target = run.landing
    pair, share = earliest_onset(target, s)
    if target != NO_PAIR:
        alone = pair in (NO_PAIR, target)
        last = run.landings >= MOST_LANDINGS
        penetration = work[at.penetration + target, lane]
        rate = work[at.penetration_rate + target, lane]
        if alone and abs(penetration) <= (LANDED_AT_LAST if last else LANDED):
            return True
        if last:
            shorten(s)
            return False
        if penetration < 0.0 and rate <= 0.0 and pair == NO_PAIR:
            run.landing = NO_PAIR
            return True
        if alone:
            share = newton_step(1.0, penetration, rate, work[at.tried, lane])
            pair, share = target, min(max(share, 0.1), 2.0)
    if pair == NO_PAIR:
        return True
    run.landing = pair
    run.landings += 1
    work[at.next_step, lane] = share * work[at.tried, lane]
    return False


@inner_kernel()
def closed_in_fixed_step(s: Step) -> int:
    """Return the first open pair whose gap is closed at the end of a fixed step."""
    lane, at, work = s.lane, s.at, s.work
    for j in range(at.pairs):
        if work[at.restart + j, lane] == np.inf and lands_beside(j, s):
            return j
    return NO_PAIR


@inner_kernel()
def earliest_onset(target: int, s: Step) -> tuple[int, float]:
    """Return the open pair whose gap closes first inside the step, and the share of it before.

    A target that has landed does not count, nor what lands beside it. One that is too deep at the
    end counts as before all others, for when it closed does not matter then.
    """
    lane, at, work = s.lane, s.at, s.work
    pair, share = NO_PAIR, NO_ONSET
    overshot = False
    for j in range(at.pairs):
        if work[at.mode + j, lane] > 0.0:
            continue
        penetration = work[at.penetration + j, lane]
        if j == target and abs(penetration) <= LANDED:
            continue
        if target != NO_PAIR and lands_beside(j, s):
            continue
        if j == target and penetration > 0.0:
            overshot = True
            continue
        found = first_onset(j, s)
        if found < share:
            pair, share = j, found
    if overshot:
        found = -1.0
        if pair != NO_PAIR:
            found = first_onset(target, s)
        if found < share:
            pair, share = target, found
    return pair, share


@inner_kernel()
def lands_beside(j: int, s: Step) -> bool:
    """Whether an open pair's gap closes at the end of the step, too: both corners of a side.

    In a fixed step it may have closed before.
    """
    lane, at, work = s.lane, s.at, s.work
    apart, penetration = work[at.mode + j, lane] <= 0.0, work[at.penetration + j, lane]
    if work[at.restart + j, lane] == np.inf:
        return bool(apart and penetration > 0.0)
    return bool(apart and work[at.penetration_rate + j, lane] > 0.0 and abs(penetration) <= LANDED)


@inner_kernel()
def shorten(s: Step) -> None:
    """Give an onset up for now: steps are so long that one's end hardly tells of another's."""
    lane, run, at, work = s.lane, s.run, s.at, s.work
    run.landing = NO_PAIR
    run.landings += 1
    work[at.next_step, lane] = 0.25 * work[at.tried, lane]
    if run.landings > MOST_LANDINGS + MOST_SHORTENINGS:
        stop(Status.ONSET_LOST, lane, run, at, work)


@inner_kernel()
def begin_contact(j: int, now: float, s: Step) -> None:
    """Latch the impact rate of pair j, once per onset, and restart with a small step."""
    lane, at, work = s.lane, s.at, s.work
    rate = work[at.penetration_rate + j, lane]
    floored = max(rate, work[at.impact_floor + j, lane])
    work[at.mode + j, lane] = 1.0
    work[at.impact_rate + j, lane] = floored
    work[at.onset_time + j, lane], work[at.opened + j, lane] = now, np.inf
    work[at.approach_rate + j, lane] = rate
    work[at.onset_total + j, lane] = work[at.impulse + j, lane]
    work[at.highest + at.contact_row + j, lane] = 0.0
    first = work[at.restart + j, lane] / floored
    work[at.step, lane] = min(work[at.step, lane], first)


@inner_kernel()
def begin_abruptly(j: int, s: Step) -> None:
    """Begin the next step with the slopes just behind the onset of pair j, whose force jumps there.

    Those that the step before has left are without it, and no step would be short enough.
    """
    lane, at, work, kept = s.lane, s.at, s.work, s.spare
    for k in range(len(work)):
        kept[k // INSTANTS, k % INSTANTS] = work[k, lane]
    behind = 2.0 * LANDED / max(work[at.penetration_rate + j, lane], LANDED)
    work[at.stage_time, lane] += behind
    for i in range(at.step_row.coordinates):
        work[at.stage + i, lane] += behind * work[at.k1_ + i, lane]
    generated.right_hand_side(s.addresses, work)
    for i in range(at.states):
        k = at.k1_ + i
        kept[k // INSTANTS, k % INSTANTS] = work[at.slope + i, lane]
    for i in range(at.ledger):
        k = at.kledger1_ + i
        kept[k // INSTANTS, k % INSTANTS] = work[at.power + i, lane]
    for k in range(len(work)):
        work[k, lane] = kept[k // INSTANTS, k % INSTANTS]


@inner_kernel()
def end_contact(j: int, now: float, s: Step, impacts: np.ndarray) -> None:
    """Write the contact of pair j that ends now, s; NaN: it lasts beyond the run."""
    lane, at, work = s.lane, s.at, s.work
    impact = impacts[lane, s.run.impacts]
    row = at.contact_row + j
    impact.joint = j
    impact.onset = work[at.onset_time + j, lane]
    impact.release = now
    impact.approach_rate = work[at.approach_rate + j, lane]
    impact.peak_force = max(work[at.highest + row, lane], work[at.previous + row, lane])
    impact.impulse = work[at.impulse + j, lane] - work[at.onset_total + j, lane]
    s.run.impacts += 1


@inner_kernel()
def is_touching(s: Step) -> bool:
    """Whether a contact begins where this step does."""
    lane, at, work = s.lane, s.at, s.work
    found = False
    for j in range(at.pairs):
        depth = abs(work[at.penetration_start + j, lane])
        found |= work[at.mode + j, lane] > 0.0 and depth <= LANDED
    return found
