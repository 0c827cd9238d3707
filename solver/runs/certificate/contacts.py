"""The span in which the list of a trajectory's contacts is certified.

Contacts of a pair are compared one by one: the third of each companion with the third of the
others. The list is certified until a companion has a contact that another has not, or until an
onset is so uncertain that it may be taken for the one before or behind it. From there on the steps
make the contacts: their times, and how many there are.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from jointplay.records.arrays import Floats
from jointplay.solver.kernels.layout import BUNDLE
from jointplay.solver.kernels.loop.runs import Status
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.runs.certificate import estimate
from jointplay.solver.runs.certificate.companions import ONSETS, RUN, TWIN, Companions


@dataclass(frozen=True)
class CertifiedContacts:
    """Contacts of a trajectory, and those of them that its companions share."""

    until: float
    """Time until which number and order of contacts are certified, s."""
    certified: int
    """Contacts that began by then."""
    count: int
    """Contacts that began in the whole run."""
    onset_error: float | None
    """Largest estimated error of the certified onsets, s; none without any."""


def certified_contacts(
    companions: Companions, time: Floats, horizon: float, safety: float
) -> CertifiedContacts | None:
    """Return how long a trajectory's list of contacts is certified; none without a contact pair.

    Parameters
    ----------
    time : (instants,)
        Instants that the trajectory has reached, s.
    horizon
        Time until which the motion itself is known: the list is not certified beyond, s.
    safety
        Estimated errors by how far companions are apart.
    """
    pairs = len(companions.bundle.kernel.pairs)
    if not pairs:
        return None
    lanes = [_onsets(companions, lane) for lane in range(1, BUNDLE)]
    reach = np.array([_reach(companions.bundle, lane) for lane in range(1, BUNDLE)])
    spans, known_to = [], companions.forgotten_from
    for pair in range(pairs):
        onsets = [found["onset"][found["joint"] == pair] for found in lanes]
        shared, parting = _shared(onsets, reach, safety)
        spans.append(shared)
        known_to = min(known_to, parting)
    onset, bar = np.concatenate(spans, axis=1)
    until = _before(time, known_to, horizon, onset, bar)
    inside = onset <= until
    return CertifiedContacts(
        until,
        int(inside.sum()),
        _count(companions),
        float(bar[inside].max()) if inside.any() else None,
    )


def _onsets(companions: Companions, lane: int) -> NDArray[np.void]:
    """Return a lane's contacts in the order of their ends, and those that last where it stopped."""
    ended, at = companions.ended_contacts(lane), companions.bundle.lane(lane)
    if at.status == Status.DONE:
        return ended  # at its end it has written what lasted
    lasting = np.flatnonzero(at["mode"] > 0.0)
    begun = np.zeros(len(lasting), ONSETS)
    begun["joint"], begun["onset"] = lasting, at["onset_time"][lasting]
    return np.concatenate([ended, begun])


def _reach(bundle: Bundle, lane: int) -> float:
    """Return the time until which a lane tells of contacts, s."""
    at = bundle.lane(lane)
    return math.inf if at.status == Status.DONE else at.time


def _shared(onsets: list[Floats], reach: Floats, safety: float) -> tuple[Floats, float]:
    """Return onsets that lanes share with their estimated errors, and when they part, s.

    The first is (2, contacts), s, of which no two may be taken for each other; the second is
    infinite where lanes do not part. onsets : of one pair by lane, the trajectory's last.
    """
    most = max(map(len, onsets))
    table = np.full((len(onsets), most + 1), np.nan)
    for row, found in zip(table, onsets, strict=True):
        row[: len(found)] = found
    first = np.fmin.reduce(table, axis=0)  # where no lane has one: NaN
    spread = np.fmax.reduce(table, axis=0) - first
    lacking = np.isnan(table) & (reach[:, None] > first)
    own = table[-1]
    bar = safety * estimate.apart(table[:, :, None])[:, 0]
    gaps = np.diff(own, prepend=-math.inf)
    between = np.fmin(gaps, np.append(gaps[1:], math.inf))
    unlike = lacking.any(axis=0) | ~(bar < between)
    shared = int(unlike.argmax())  # in the last column no lane has a contact
    if shared == most:
        return np.stack([own[:most], bar[:most]]), math.inf
    earliest = float(first[shared] - safety * spread[shared])
    if shared:  # it comes after the last that they share, however far lanes are apart in it
        earliest = max(earliest, float(own[shared - 1] - bar[shared - 1]))
    return np.stack([own[:shared], bar[:shared]]), earliest


def _before(time: Floats, known_to: float, horizon: float, onset: Floats, bar: Floats) -> float:
    """Return the last instant, s, before lanes part, that no onset's bar reaches across."""
    begins, ends = onset - bar, onset + bar
    for instant in time[(time < known_to) & (time <= horizon)][::-1]:
        if not np.any((begins <= instant) & (instant < ends)):
            return float(instant)
    return 0.0


def _count(companions: Companions) -> int:
    """Return how many contacts the trajectory began with, or began."""
    closed_at_start = int(np.count_nonzero(_onsets(companions, TWIN)["onset"] == 0.0))
    return int(companions.bundle.lane(RUN).run["onsets"]) + closed_at_start
