"""The certificate of a trajectory, put together from its companions."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.records.channel import Channel
from jointplay.solver.kernels.layout import BUNDLE
from jointplay.solver.kernels.loop.runs import Status
from jointplay.solver.runs.certificate import estimate
from jointplay.solver.runs.certificate.companions import (
    LADDER,
    PERTURBED,
    RUN,
    TIGHTEST,
    TWIN,
    Companions,
)
from jointplay.solver.runs.certificate.growth import Exponent
from jointplay.solver.runs.certificate.kinds import FORCE, MEANINGS, PRESCRIBED, kinds_of
from jointplay.solver.runs.certificate.slow_impacts import slow_impacts
from jointplay.solver.runs.certificate.steepness import steepness
from jointplay.solver.runs.lane_results import ledger_of, peaks_of, statistics_of
from jointplay.solver.runs.lasting_contacts import lasting_contacts
from jointplay.solver.runs.starts import start_scales
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.joints import Clearance
from jointplay.solver.scene.pairs import contact_pairs
from jointplay.solver.scene.references import tangent_obstacle

JOURNAL = ("eccentricity_x", "eccentricity_y", "penetration")
"""Channels of a contact pair whose scale is the clearance from side to side, not their range."""
COORDINATES = ("x", "y", "theta")
UNLIKE, CHANCE = 0.25, 4.0
"""Numbers of contacts are unlike where they differ by this share, and by so many times the root of
both together: what chance makes of impacts that scatter."""
OF_WINDOWS = (
    "The error is that of the windows, which take the run's own steps; what the steps add to it, a"
    " poincare study tells: it goes on in far smaller ones."
)
HARDLY = 1e-3
"""A channel that moves by less than this share of another of its unit is measured by that one."""


@dataclass(frozen=True)
class Certificate:
    """Certificate of a trajectory: how far it can be believed."""

    time: Floats
    """(instants,) s, from 0 to the end of the run."""
    error: Floats
    """(instants, channels) estimated errors, in the channels' units; where the motion is not
    converged, no more than how far companions are apart. Infinite where too few of them came."""
    until: Floats
    """(channels,) time until which the error stays below a share of the channel's scale, s."""
    extremes: Floats
    """(channels, 4) lowest and highest minimum, lowest and highest maximum of several lanes."""
    edges: Floats
    """(BINS + 1, channels) of bins."""
    share: Floats
    """(BINS, channels) of time that channels spend there."""
    spread: Floats
    """(BINS, channels) its standard deviation over companions."""
    facts: dict[str, Any]
    """The rest, as a JSON document."""

    @classmethod
    def of_exact(cls, channels: int, duration: float) -> Certificate:
        """Return the certificate of a motion that follows from its drivers alone."""
        nothing = np.zeros((0, channels))
        facts = {
            "note": "Nothing is integrated: the drivers prescribe the motion, which is evaluated"
            " at each instant to rounding.",
            "horizon": duration,
            "converged": [[0.0, duration]],
            "bars": {PRESCRIBED: MEANINGS[PRESCRIBED]},
            "kinds": [PRESCRIBED] * channels,
        }
        return cls(
            np.zeros(0),
            nothing,
            np.full(channels, duration),
            np.full((channels, 4), np.nan),
            np.full((estimate.BINS + 1, channels), np.nan),
            np.full((estimate.BINS, channels), np.nan),
            np.full((estimate.BINS, channels), np.nan),
            facts,
        )


def certify(
    companions: Companions,
    scene: Scene,
    channels: Sequence[Channel],
    tolerance: float,
    exponent: Exponent | None,
    violation: Floats | None,
) -> Certificate:
    """Put a trajectory's certificate together.

    `companions` : each at its end, or left behind; `channels` : those that the job selected;
    `violation` : see `Violation.largest`, none where there are no constraints.
    """
    bundle, time = companions.bundle, companions.instants.time
    rows = bundle.kernel.rows
    names = [channel.name for channel in channels]
    motion, index = _motion(scene), rows.names.index
    columns = np.array([index(name) for name in [*names, *motion]], dtype=np.int64)
    values = companions.values(columns)
    units = [channel.unit for channel in channels] + list(motion.values())
    scales = _scales(values, [*names, *motion], units, scene)
    count = len(names)
    safety = estimate.SAFETY if bundle.kernel.tableau.error else estimate.UNCONTROLLED
    apart = safety * estimate.apart(values)
    near = estimate.near_claims(apart[:, count:], scales[count:])
    steep = steepness(companions, safety, columns, values[TWIN - 1], near)
    error = estimate.around(np.maximum(apart, steep))
    small = estimate.within(error, scales)
    known = estimate.spans(small[:, count:], time)
    edges, share, spread = estimate.histogram(values[:, :, :count], time)
    until = estimate.until(small[:, :count], time)
    kinds = kinds_of(channels, rows)
    forces = [end for end, kind in zip(until, kinds, strict=True) if kind == FORCE]
    energy = ledger_of(bundle, RUN)
    gross = energy["gross_work"]
    remarks = (
        _nothing_known(known[0][1], time),
        _different_contacts(companions),
        _latched(companions, scene, 0.5 * float(time[-1])),
        _beyond_law(companions, scene),
        slow_impacts(bundle, RUN),
    )
    facts = {
        "note": " ".join(filter(None, remarks)),
        "horizon": known[0][1],
        "forces_until": float(min(forces)) if forces else None,
        "converged": known,
        "criterion": f"the estimated error of each journal's centre is below"
        f" {estimate.CONVERGED:g} of its clearance from side to side, and that of each body's"
        f" position and angle below {estimate.CONVERGED:g} of its range",
        "safety": safety,
        "bars": {kind: MEANINGS[kind] for kind in MEANINGS if kind in kinds},
        "kinds": kinds,
        "exponent": None if exponent is None else asdict(exponent),
        "exponent_note": OF_WINDOWS
        if exponent is not None
        else tangent_obstacle(scene) or "No window of the run was long enough.",
        "slow_impacts": int(bundle.lane(RUN).run["slow"]),
        "energy_residual": energy["residual"],
        "gross_work": gross,
        "energy_error": abs(energy["residual"]) / gross if gross > 0.0 else None,
        "constraint_violation": _violation(violation),
        "lanes": [_lane(companions, lane, tolerance) for lane in range(BUNDLE)],
        "lanes_with_extremes": [RUN, *companions.loud],
    }
    return Certificate(
        time,
        error[:, :count],
        until,
        _extremes(companions, names),
        edges,
        share,
        spread,
        facts,
    )


def _nothing_known(horizon: float, time: Floats) -> str:
    """Return a remark where companions are apart from the first instant on."""
    if horizon > 0.0:
        return ""
    return (
        f"Companions are compared first at {time[1]:.3g} s, and are apart by then. How long the"
        " motion is known before that, a run of that length tells."
    )


def _motion(scene: Scene) -> dict[str, str]:
    """Return channels whose errors say how long the trajectory is known, with their units."""
    journals = [name for name, pair in contact_pairs(scene).items() if pair.is_journal]
    found = {f"{name}.{part}": "m" for name in journals for part in JOURNAL[:2]}
    for body in scene.bodies:
        found |= {f"{body}.{part}": "rad" if part == "theta" else "m" for part in COORDINATES}
    return found


def _scales(values: Floats, names: Sequence[str], units: Sequence[str], scene: Scene) -> Floats:
    """Return what errors are compared with, (channels,), in the channels' units."""
    reached = values[~np.isnan(values).any(axis=(1, 2))]
    if not len(reached):
        reached = np.nan_to_num(values)
    ranges = np.ptp(reached, axis=(0, 1))
    of_unit = np.array(units)
    largest = np.array([ranges[of_unit == unit].max() for unit in units])
    scales: Floats = np.maximum(ranges, HARDLY * largest)
    finest = start_scales(scene, names, 1.0)  # of positions and angles, where there is play
    play = contact_pairs(scene)
    for column, name in enumerate(names):
        owner, _, quantity = name.rpartition(".")
        if quantity in JOURNAL:
            scales[column] = 2.0 * play[owner].play
        elif play and quantity in COORDINATES:
            scales[column] = max(scales[column], finest[column])
    return scales


def _extremes(companions: Companions, names: Sequence[str]) -> Floats:
    """Return lowest and highest minima and maxima of the lanes that sought them."""
    bundle, rows = companions.bundle, companions.bundle.kernel.rows
    sought = [name for name in names if name in rows.watched or name in rows.multiples]
    run = peaks_of(bundle, RUN, names)  # what drivers prescribe is the same in all lanes
    found = [run, *(run | peaks_of(bundle, lane, sought) for lane in companions.loud)]
    low = np.array([[peaks[name].minimum for name in names] for peaks in found])
    high = np.array([[peaks[name].maximum for name in names] for peaks in found])
    return np.stack([low.min(0), low.max(0), high.min(0), high.max(0)], axis=1)


def _different_contacts(companions: Companions) -> str:
    """Return a remark where the trajectory and its tightest companion touch unlike often."""
    own, theirs = (companions.bundle.lane(lane) for lane in (RUN, TIGHTEST))
    if not own.status == theirs.status == Status.DONE:
        return ""
    counts = int(own.run["onsets"]), int(theirs.run["onsets"])
    chance = CHANCE * math.sqrt(sum(counts))
    if abs(counts[0] - counts[1]) <= max(chance, UNLIKE * max(counts)):
        return ""
    return (
        f"The trajectory has {counts[0]} contacts, and {counts[1]} at a quarter of its tolerance:"
        " beyond the horizon its impacts are made by its steps. Ask for a smaller tolerance."
    )


def _latched(companions: Companions, scene: Scene, half: float) -> str:
    """Return a remark where a latched rate governs the second half of a run, from a time, s, on."""
    found = lasting_contacts(companions.bundle, RUN, scene, half)
    return f"In the second half of the run {found}." if found else ""


def _beyond_law(companions: Companions, scene: Scene) -> str:
    """Return a remark where contacts were deeper than the formula of their law goes."""
    deepest = {
        f"{name}.penetration": float(pair.clearance.contact.deepest(pair.clearance))
        for name, pair in contact_pairs(scene).items()
        if isinstance(pair.clearance, Clearance)
    }
    peaks = peaks_of(companions.bundle, RUN, list(deepest))
    found = [
        f"{name} {peaks[name].maximum:.3g} m, beyond {depth:.3g} m"
        for name, depth in deepest.items()
        if peaks[name].maximum > depth
    ]
    if not found:
        return ""
    return (
        f"Contacts were deeper than their law's formula goes ({', '.join(found)}): there the force"
        " goes on along its tangent."
    )


def _violation(largest: Floats | None) -> dict[str, Any]:
    if largest is None:
        note = "Zero by construction: joint coordinates satisfy the constraints."
        return {"position": 0.0, "angle": 0.0, "note": note}
    return {"position": float(largest[0]), "angle": float(largest[1]), "note": ""}


def _lane(companions: Companions, lane: int, tolerance: float) -> dict[str, Any]:
    """Return what one lane computed and what that cost."""
    at, found = companions.bundle.lane(lane), statistics_of(companions.bundle, lane)
    return {
        "tolerance": tolerance * ((1.0, *LADDER)[lane] if lane <= len(LADDER) else 1.0),
        "perturbed": lane in PERTURBED,
        "time": at.time,
        "complete": at.status == Status.DONE,
        "steps": found["steps"],
        "rejections": found["rejections"],
        "onsets": found["onsets"],
        "smallest_step": found["smallest_step"],
        "energy_residual": found["energy"]["residual"],
    }
