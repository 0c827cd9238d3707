"""Remarks of a certificate about a run, as sentences; empty where there is nothing to say."""

import math
from dataclasses import dataclass

from jointplay.records.arrays import Floats
from jointplay.solver.kernels.loop.runs import Status
from jointplay.solver.runs.certificate.companions import RUN, TIGHTEST, Companions
from jointplay.solver.runs.certificate.contacts import CertifiedContacts
from jointplay.solver.runs.certificate.slow_impacts import slow_impacts
from jointplay.solver.runs.lane_results import peaks_of
from jointplay.solver.runs.lasting_contacts import lasting_contacts
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.pairs import contact_pairs

UNLIKE, CHANCE = 0.25, 4.0
"""Numbers of contacts are unlike where they differ by this share, and by so many times the root of
both together: what chance makes of impacts that scatter."""
USUAL = 10.0
"""Residual of the energy ledger, in tolerances of the gross work, above which a run says so."""
LARGE = 0.01
"""The same of fixed steps, as a share of the gross work."""


@dataclass(frozen=True)
class Lacking:
    """Share that the energy ledger of a run lacks; none where it is rounding."""

    tolerances: float | None
    """Times the tolerance of the gross work; none where steps are fixed."""
    share: float | None
    """Share of the gross work; none where steps are not fixed."""


def remarks(
    companions: Companions,
    scene: Scene,
    time: Floats,
    horizon: float,
    contacts: CertifiedContacts | None,
    lacking: Lacking,
) -> str:
    """Return all that there is to remark about a run.

    Parameters
    ----------
    time : (instants,)
        Instants that were compared, s.
    horizon
        s.
    contacts
        Those that are certified; none where nothing can touch.
    lacking
        By what the energy ledger is off.
    """
    found = (
        _nothing_known(time, horizon),
        "" if contacts is None else _made_by_steps(contacts, float(time[-1])),
        _different_contacts(companions),
        _energy(lacking),
        _latched(companions, scene, 0.5 * float(time[-1])),
        _beyond_law(companions, scene),
        slow_impacts(companions.bundle, RUN),
    )
    return " ".join(filter(None, found))


def _nothing_known(time: Floats, horizon: float) -> str:
    """Return a remark where companions are apart from the first instant on."""
    if horizon > 0.0:
        return ""
    if len(time) == 1:
        return "The run ended before its companions could be compared."
    return (
        f"Companions are compared first at {time[1]:.3g} s, and are apart by then. How long the"
        " motion is known before that, a run of that length tells."
    )


def _made_by_steps(contacts: CertifiedContacts, end: float) -> str:
    """Return a remark where the list of contacts is not certified to the end, s."""
    if contacts.until >= end:
        return ""
    return (
        f"The list of contacts is certified until {contacts.until:.4g} s, {contacts.certified} of"
        f" {contacts.count}: how many follow, and when, is what the trajectory's steps made of it."
    )


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
        " ask for a smaller tolerance."
    )


def _energy(lacking: Lacking) -> str:
    """Return a remark where the energy ledger lacks more than runs usually do."""
    if lacking.share is not None and not lacking.share <= LARGE:
        return (
            f"The energy ledger lacks {lacking.share:.2g} of the gross work: the steps are too long"
            " for this motion, which loses or gains energy by nothing else."
        )
    if lacking.tolerances is None or not lacking.tolerances > USUAL:
        return ""
    return (
        f"The energy ledger lacks {lacking.tolerances:.3g} times the tolerance of the gross work,"
        f" where most runs lack less than {USUAL:g}: works and losses are known to that, and a"
        " smaller tolerance makes it less."
    )


def _latched(companions: Companions, scene: Scene, half: float) -> str:
    """Return a remark where a latched rate governs the second half of a run, from a time, s, on."""
    found = lasting_contacts(companions.bundle, RUN, scene, half)
    return f"In the second half of the run {found}." if found else ""


def _beyond_law(companions: Companions, scene: Scene) -> str:
    """Return a remark where contacts were deeper than the formula of their law goes."""
    deepest = {
        f"{name}.penetration": float(pair.of.deepest)
        for name, pair in contact_pairs(scene).items()
        if math.isfinite(pair.of.deepest)
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
