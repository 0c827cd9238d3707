"""Results of a lane: its extremes, what it cost, its energy ledger, and how it failed."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.records.failure import SimulationFailed
from jointplay.records.peak import Peak
from jointplay.solver.kernels.emit.slots import TIME
from jointplay.solver.kernels.loop.runs import PACE_STEPS, SLOWEST_PACE, Status
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.lane import Lane
from jointplay.solver.quantities.extremes import refined_peaks
from jointplay.solver.runs.centred_journals import centred_journal
from jointplay.solver.runs.left_domains import left_domain
from jointplay.solver.scene.document import Scene

INSTANTS_A_PERIOD, INSTANTS_A_BEND = 720, 64
"""Instants at which channels of time alone are first looked at: in a common period of the drivers,
and in the shortest time in which one of these, or a force, turns or bends."""
MOST_INSTANTS = 200_000


def peaks_of(bundle: Bundle, lane: int, names: Sequence[str]) -> dict[str, Peak]:
    """Return the extremes of channels so far, in the order of the names."""
    rows, at = bundle.kernel.rows, bundle.lane(lane)
    ends = [_record(at, end, sense) for end, sense in (("lowest", -1.0), ("highest", 1.0))]
    columns = [column.tolist() for column in (*ends[0], *ends[1])]
    found = {name: Peak(*row) for name, *row in zip(rows.watched, *columns, strict=False)}
    for name, (source, factor, offset) in rows.multiples.items():
        found[name] = found[source].scaled(factor, offset)
    unwatched = [name for name in names if name not in found]
    if unwatched:
        found |= prescribed_peaks(bundle, lane, unwatched, at.time)
    return {name: found[name] for name in names}


def _record(at: Lane, end: str, sense: float) -> tuple[Floats, Floats]:
    """Return extremes of one side so far, (rows,), and their times, s.

    A channel is looked at where it turns, and at the end of a run: of a lane that has not come to
    its end, what it rises or falls to is not recorded yet.
    """
    values, times = at[end], at[f"{end}_time"]
    if at.status == Status.DONE:
        return values, times
    now = at["previous"]
    beyond = sense * now > sense * values
    return np.where(beyond, now, values), np.where(beyond, at.time, times)


def prescribed_peaks(
    bundle: Bundle, lane: int, names: list[str], reached: float
) -> dict[str, Peak]:
    """Return extremes, over 0..reached, s, of channels that drivers prescribe.

    They are functions of time alone, sought afterwards; a common period is looked at once.
    """
    kernel, at = bundle.kernel, bundle.lane(lane)
    period, common = float(at.run["period"]), bool(at.run["common"])
    span = min(reached, period) if common else reached
    columns = np.array([kernel.rows.index(name) for name in names], dtype=np.int64)

    def evaluate(times: Floats) -> Floats:
        rows = np.zeros((len(times), kernel.row.width))
        rows[:, TIME] = times
        rows[:, kernel.row.phase : kernel.row.wound] = at["clock_start"]
        return bundle.observe(lane, rows, columns)

    bend = float(at.run["unit"])
    wanted = max(INSTANTS_A_PERIOD * span / period, INSTANTS_A_BEND * span / bend)
    count = min(math.ceil(wanted) + 16, MOST_INSTANTS)
    times = np.linspace(0.0, span, count)
    return refined_peaks(names, evaluate, times, evaluate(times))


def statistics_of(bundle: Bundle, lane: int) -> dict[str, Any]:
    """Return steps, rejections, onsets, slow ones, rough steps, smallest step (s), ledger (J)."""
    at = bundle.lane(lane)
    return {
        "steps": at.steps,
        "rejections": int(at.run["rejections"]),
        "onsets": int(at.run["onsets"]),
        "slow_impacts": int(at.run["slow"]),
        "rough_steps": int(at.run["rough"]),
        "smallest_step": at.number("smallest_step") if at.steps else None,
        "energy": ledger_of(bundle, lane),
    }


def ledger_of(bundle: Bundle, lane: int) -> dict[str, float]:
    """Energy at the end less at the start must be the work put in less what was lost, J.

    The residual is the error of that; the gross work, the sum of all works of single steps without
    their signs, is what it is to be held against.
    """
    at, losses = bundle.lane(lane), bundle.kernel.losses
    terms = [float(x) for x in at["total"][: losses + len(bundle.kernel.equations.drivers)]]
    (contact, friction, *elements), works = terms[:losses], terms[losses:]
    driver, gross = sum(works), at.number("gross")
    kinetic, potential, stored = (
        float(x) for x in bundle.energy(lane) - bundle.first_energy[:, lane]
    )
    element_loss = sum(elements, 0.0)
    return {
        "driver_work": driver,
        "gravity_work": -potential,
        "contact_loss": contact,
        "friction_loss": friction,
        "element_loss": element_loss,
        "kinetic_change": kinetic,
        "stored_change": stored,
        "gross_work": gross,
        "residual": kinetic + stored - driver + potential + contact + friction + element_loss,
    }


def whereabouts(bundle: Bundle, lane: int) -> str:
    """Say how a lane came to where it is, and what is in contact there."""
    at = bundle.lane(lane)
    touching = [name for name, mode in zip(bundle.kernel.pairs, at["mode"], strict=True) if mode]
    contact = f"in contact: {', '.join(touching)}" if touching else "nothing in contact"
    return (
        f" after {at.steps} steps of '{bundle.kernel.tableau.name}', the last"
        f" {at.number('tried'):.2g} s long, with {contact}"
    )


def out_of_time(seconds: float, at: float, where: str) -> SimulationFailed:
    """Return what ends a run that computes too long, at the time that it has reached, s.

    where : words from `whereabouts`, if a kernel computes it.
    """
    friction = (
        ", or, where friction holds joints, a wider gap between static_velocity and"
        " dynamic_velocity"
    )
    return SimulationFailed(
        "time-limit",
        f"t = {at:.9g} s was reached in {seconds:g} s of computing, the limit of a run{where}. Ask"
        f" for a shorter duration or a larger tolerance{friction if where else ''}.",
        at,
    )


def failure_of(bundle: Bundle, lane: int, tolerance: float, scene: Scene) -> SimulationFailed:
    """Return what stopped a lane that is neither running nor done."""
    stopped = bundle.lane(lane)
    left = left_domain(bundle, lane, scene)
    if left:
        sentence = f"At t = {stopped.time:.9g} s {left}."
        return SimulationFailed("outside-of-a-function", sentence, stopped.time)
    status, at, steps = stopped.status, stopped.time, stopped.steps
    step, fixed = stopped.number("next_step"), not bundle.kernel.tableau.error
    if fixed and status in (Status.UNDERFLOW, Status.NO_PROGRESS):
        return SimulationFailed(
            "fixed-step-too-long",
            f"With its fixed step the motion grew beyond all numbers by t = {at:.9g} s. Choose a"
            " smaller 'step', or a method that controls its error.",
            at,
        )
    if status in (Status.UNDERFLOW, Status.NO_PROGRESS):
        slow = f"The last {PACE_STEPS} steps brought the run on by less than {SLOWEST_PACE:g} of"
        slow += " the fastest period,"
        fell = f"The step fell to {step:.3g} s"
        centred = centred_journal(bundle, lane, scene)
        advice = (
            "Try a larger tolerance, a lower contact stiffness, or a wider gap between"
            " static_velocity and dynamic_velocity"
        )
        return SimulationFailed(
            "step-size-underflow",
            f"{fell if status == Status.UNDERFLOW else slow}"
            f" at t = {at:.9g} s after {steps} steps: the motion cannot be followed at tolerance"
            f" {tolerance:g}{f', as {centred}' if centred else f'. {advice}'}.",
            at,
        )
    if status == Status.STEP_LIMIT:
        return SimulationFailed(
            "step-limit",
            f"{steps} steps were made by t = {at:.9g} s, the limit of a run. Ask for a shorter"
            " duration or a larger tolerance.",
            at,
        )
    return SimulationFailed(
        "onset-not-located",
        f"The beginning of a contact near t = {at:.9g} s could not be located to 1e-9 m."
        f" Try a smaller {'step' if fixed else 'tolerance'}.",
        at,
    )
