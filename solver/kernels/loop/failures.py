"""The account of a lane: its extremes, what it cost, its energy ledger, and how it failed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from jointplay.records.failure import SimulationFailed
from jointplay.records.impact import IMPACT
from jointplay.records.peak import Peak
from jointplay.solver.kernels.emit.kernel import LOSSES
from jointplay.solver.kernels.loop.bundle import Bundle
from jointplay.solver.kernels.loop.prescribed import prescribed_peaks
from jointplay.solver.kernels.loop.state import Counter, Status


def peaks_of(bundle: Bundle, lane: int, names: Sequence[str]) -> dict[str, Peak]:
    """Return the extremes of channels so far, in the order of the names."""
    rows = bundle.kernel.rows
    records = [
        bundle.table(f"{block}0", rows.scanned)[:, lane]
        for block in ("lowest", "lowest_time", "highest", "highest_time")
    ]
    found = {
        name: Peak(*(float(column[r]) for column in records)) for r, name in enumerate(rows.watched)
    }
    for name, (source, factor, offset) in rows.multiples.items():
        found[name] = found[source].scaled(factor, offset)
    unwatched = [name for name in names if name not in found]
    if unwatched:
        found |= prescribed_peaks(bundle, lane, unwatched, bundle.time(lane))
    return {name: found[name] for name in names}


def statistics_of(bundle: Bundle, lane: int) -> dict[str, Any]:
    """Return steps, rejections, onsets, the smallest step (s) and the energy ledger (J)."""
    counters = bundle.counters[:, lane]
    steps = int(bundle.table("steps")[0, lane])
    return {
        "steps": steps,
        "rejections": int(counters[Counter.REJECTIONS]),
        "onsets": int(counters[Counter.ONSETS]),
        "smallest_step": float(bundle.table("smallest_step")[0, lane]) if steps else None,
        "energy": ledger_of(bundle, lane),
    }


def contacts_of(bundle: Bundle, lane: int) -> NDArray[np.void]:
    """Return the contacts of a lane that ended in the last call, of dtype `IMPACT`."""
    rows = bundle.impact_rows[lane, : bundle.counters[Counter.IMPACT_ROWS, lane]]
    contacts = np.zeros(len(rows), dtype=IMPACT)
    for column, name in enumerate(IMPACT.names or ()):
        contacts[name] = rows[:, column]
    return contacts


def ledger_of(bundle: Bundle, lane: int) -> dict[str, float]:
    """Energy at the end less at the start must be the work put in less what was lost, J.

    The residual is the error of that; the gross work, the sum of all works of single steps without
    their signs, is what it is to be held against.
    """
    drivers = len(bundle.kernel.drivers)
    contact, friction, *works = (
        float(x) for x in bundle.table("total0", LOSSES + drivers)[:, lane]
    )
    driver, gross = sum(works), float(bundle.table("gross")[0, lane])
    kinetic, potential, stored = (
        float(x) for x in bundle.energy(lane) - bundle.first_energy[:, lane]
    )
    return {
        "driver_work": driver,
        "gravity_work": -potential,
        "contact_loss": contact,
        "friction_loss": friction,
        "kinetic_change": kinetic,
        "stored_change": stored,
        "gross_work": gross,
        "residual": kinetic + stored - driver + potential + contact + friction,
    }


def out_of_time(seconds: float, at: float) -> SimulationFailed:
    """Return what ends a run that computes too long, at the time that it has reached, s."""
    return SimulationFailed(
        "time-limit",
        f"t = {at:.9g} s was reached in {seconds:g} s of computing, the limit of a run. Ask for a"
        " shorter duration or a larger tolerance.",
        at,
    )


def failure_of(bundle: Bundle, lane: int, tolerance: float) -> SimulationFailed:
    """Return what stopped a lane that is neither running nor done."""
    status = Status(bundle.counters[Counter.STATUS, lane])
    at = bundle.time(lane)
    step = float(bundle.table("next_step")[0, lane])
    steps = int(bundle.table("steps")[0, lane])
    if not bundle.kernel.tableau.error:
        return SimulationFailed(
            "fixed-step-too-long",
            f"With its fixed step the motion grew beyond all numbers by t = {at:.9g} s. Choose a"
            " smaller 'step', or a method that controls its error.",
            at,
        )
    if status == Status.UNDERFLOW:
        return SimulationFailed(
            "step-size-underflow",
            f"The step fell to {step:.3g} s at t = {at:.9g} s after {steps} steps: the motion"
            f" cannot be followed at tolerance {tolerance:g}. Try a larger tolerance, a lower"
            " contact stiffness, or a wider gap between static_velocity and dynamic_velocity.",
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
        " Try a smaller tolerance.",
        at,
    )
