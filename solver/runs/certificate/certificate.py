"""The certificate of a trajectory, put together from its companions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
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
    Companions,
)
from jointplay.solver.runs.certificate.contacts import certified_contacts
from jointplay.solver.runs.certificate.errors import errors_of
from jointplay.solver.runs.certificate.growth import SHORTEST, Exponent
from jointplay.solver.runs.certificate.kinds import FORCE, MEANINGS, PRESCRIBED, kinds_of
from jointplay.solver.runs.certificate.remarks import Lacking, remarks
from jointplay.solver.runs.certificate.scales import (
    CRITERION,
    UNCONTROLLED_CRITERION,
    motion_of,
    scales_of,
)
from jointplay.solver.runs.lane_results import ledger_of, peaks_of, statistics_of
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.references import tangent_obstacle

ROUNDING = 1e-13
"""Share of the energies by which the ledger may be off for nothing but rounding."""
OF_WINDOWS = (
    "The error is that of the windows, which take the run's own steps; what the steps add to it, a"
    " poincare study tells: it goes on in far smaller ones."
)

TOO_SHORT = (
    f"No window of the run was long enough: {BUNDLE} of them, apart from one another, take"
    f" {BUNDLE * SHORTEST} steps."
)


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
    def of_exact(cls, channels: int, reached: float) -> Certificate:
        """Return the certificate of a motion that follows from its drivers alone.

        `reached` : the time until which there is one, s.
        """
        nothing = np.zeros((0, channels))
        facts = {
            "note": "Nothing is integrated: the drivers prescribe the motion, which is evaluated"
            " at each instant to rounding.",
            "horizon": reached,
            "converged": [[0.0, reached]],
            "bars": {PRESCRIBED: MEANINGS[PRESCRIBED]},
            "kinds": [PRESCRIBED] * channels,
        }
        return cls(
            np.zeros(0),
            nothing,
            np.full(channels, reached),
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
    bundle, time = companions.bundle, companions.instants.time[: companions.compared]
    rows = bundle.kernel.rows
    names = [channel.name for channel in channels]
    motion, index = motion_of(scene), rows.names.index
    columns = np.array([index(name) for name in [*names, *motion]], dtype=np.int64)
    values = companions.values(columns)
    units = [channel.unit for channel in channels] + list(motion.values())
    controlled = bool(bundle.kernel.tableau.error)
    scales = scales_of(values, [*names, *motion], units, scene, controlled)
    count = len(names)
    safety = estimate.SAFETY if controlled else estimate.UNCONTROLLED
    error, horizon = errors_of(companions, columns, values, scales, safety, count)
    known = estimate.scales_from(scales, int(np.searchsorted(time, horizon)))
    small = estimate.within(error[:, count:], known[:, count:])
    edges, share, spread = estimate.histogram(values[:, :, :count], time)
    until = estimate.until(error[:, :count], scales[:, :count], time)
    kinds = kinds_of(channels, rows)
    forces = [end for end, kind in zip(until, kinds, strict=True) if kind == FORCE]
    contacts = certified_contacts(companions, time, horizon, safety)
    energy = _energy(companions, tolerance)
    lanes = _lanes_with_extremes(companions)
    facts = {
        "note": remarks(companions, scene, time, horizon, contacts, _lacking(companions, energy)),
        "horizon": horizon,
        "forces_until": float(min(forces)) if forces else None,
        "converged": estimate.spans(small, time),
        "criterion": CRITERION if controlled else UNCONTROLLED_CRITERION,
        "impacts": None if contacts is None else asdict(contacts),
        "safety": safety,
        "bars": {kind: MEANINGS[kind] for kind in MEANINGS if kind in kinds},
        "kinds": kinds,
        **_exponent(exponent, scene),
        "slow_impacts": int(bundle.lane(RUN).run["slow"]),
        **energy,
        "constraint_violation": _violation(violation),
        "lanes": [_lane(companions, lane, tolerance) for lane in range(BUNDLE)],
        "lanes_with_extremes": lanes,
    }
    return Certificate(
        time,
        error[:, :count],
        until,
        _extremes(companions, names, lanes),
        edges,
        share,
        spread,
        facts,
    )


def _exponent(found: Exponent | None, scene: Scene) -> dict[str, Any]:
    """Return a run's exponent, and how far it holds, or why there is none."""
    if found is None:
        note = tangent_obstacle(scene) or TOO_SHORT
        return {"exponent": None, "exponent_note": note}
    return {"exponent": asdict(found), "exponent_note": OF_WINDOWS}


def _energy(companions: Companions, tolerance: float) -> dict[str, float | None]:
    """Return what the trajectory's energy ledger lacks, J, and in shares of its gross work."""
    bundle = companions.bundle
    ledger = ledger_of(bundle, RUN)
    residual, gross = ledger["residual"], ledger["gross_work"]
    share = abs(residual) / gross if gross > 0.0 else None
    # fixed steps keep no tolerance; where hardly any work is done, rounding is all that is lacking
    kept = bundle.kernel.tableau.error and not _is_rounding(companions, residual)
    return {
        "energy_residual": residual,
        "gross_work": gross,
        "energy_error": share,
        "energy_in_tolerances": share / tolerance if kept and share is not None else None,
    }


def _is_rounding(companions: Companions, residual: float) -> bool:
    """Return whether a residual of the ledger, J, is not more than rounding of its energies."""
    return abs(residual) <= ROUNDING * float(np.abs(companions.bundle.energy(RUN)).max())


def _lacking(companions: Companions, energy: Mapping[str, float | None]) -> Lacking:
    """Return what a ledger lacks, `_energy` of it, as remarks need it."""
    residual, share = energy["energy_residual"], energy["energy_error"]
    controlled = bool(companions.bundle.kernel.tableau.error)
    if controlled or share is None or _is_rounding(companions, residual or 0.0):
        share = None
    return Lacking(energy["energy_in_tolerances"], share)


def _lanes_with_extremes(companions: Companions) -> list[int]:
    """Return lanes that sought extremes, none of more time than the trajectory has computed."""
    run = companions.bundle.lane(RUN)
    whole = run.status == Status.DONE
    lanes = [companions.bundle.lane(lane) for lane in companions.loud]
    return [
        RUN,
        *(k for k, at in zip(companions.loud, lanes, strict=True) if whole or at.time <= run.time),
    ]


def _extremes(companions: Companions, names: Sequence[str], lanes: Sequence[int]) -> Floats:
    """Return lowest and highest minima and maxima of lanes that sought them, the run's first."""
    bundle, rows = companions.bundle, companions.bundle.kernel.rows
    sought = [name for name in names if name in rows.watched or name in rows.multiples]
    run = peaks_of(bundle, RUN, names)  # what drivers prescribe is the same in all lanes
    found = [run, *(run | peaks_of(bundle, lane, sought) for lane in lanes[1:])]
    low = np.array([[peaks[name].minimum for name in names] for peaks in found])
    high = np.array([[peaks[name].maximum for name in names] for peaks in found])
    return np.stack([low.min(0), low.max(0), high.min(0), high.max(0)], axis=1)


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
