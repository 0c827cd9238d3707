"""Steepness of the laws: how channels change where the state is as wrong as its bar allows.

Companions that agree in a state to a millionth may all be on one side of a contact's onset, or of
a ramp of friction, whose forces the truth has not. So channels are evaluated again where the state
is several times as far from the trajectory's as a companion's is, and as far on the other side.
"""

from itertools import pairwise

import numpy as np

from jointplay.records.arrays import Flags, Floats, Integers
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.runs.certificate.companions import (
    PERTURBED,
    RUN,
    TIGHTER,
    TIGHTEST,
    TWIN,
    Companions,
)

TOWARDS = (TIGHTEST, TIGHTER, *PERTURBED)
"""Lanes whose differences from the trajectory are directions."""
CONTACT = (
    "penetration",
    "eccentricity_x",
    "eccentricity_y",
    "eccentricity_rate_x",
    "eccentricity_rate_y",
)
"""Channels of a journal that tell whether, and how fast, it has entered."""
WALL = ("penetration", "penetration_rate")
"""Those of a point at a wall."""


def steepness(
    companions: Companions, safety: float, columns: Integers, values: Floats, wanted: Flags
) -> Floats:
    """Return the largest change of each channel, (instants, channels), in the channels' units.

    safety : by how much farther the state moves than companions are from the trajectory's.
    values : (instants, channels) of the trajectory. wanted : (instants,) where it is looked for.
    """
    row = companions.bundle.kernel.row
    own = companions.dense(TWIN)
    states, moved = [], []
    for lane in TOWARDS:
        theirs = companions.dense(lane)
        both = np.flatnonzero(wanted[: min(len(own), len(theirs))])
        apart = safety * (row.states(theirs[both]) - row.states(own[both]))
        for sense in (1.0, -1.0):
            states.append(both)
            moved.append(own[both])
            row.states(moved[-1])[:] += sense * apart
    found = _observed(companions.bundle, np.concatenate(moved), columns)
    ends = np.cumsum([len(both) for both in states])
    largest = np.zeros_like(values)
    for both, there in zip(states, np.split(found, ends[:-1]), strict=True):
        largest[both] = np.fmax(largest[both], np.abs(there - values[both]))
    return largest


def _observed(bundle: Bundle, moved: Floats, columns: Integers) -> Floats:
    """Return channels, (count, channels), at states of which some have entered a contact."""
    rows, row = bundle.kernel.rows, bundle.kernel.row
    shapes = zip(bundle.kernel.pairs, bundle.kernel.equations.enclosures, strict=True)
    told = [(pair, CONTACT if shape == "circle" else WALL) for pair, shape in shapes]
    seen = [rows.index(f"{pair}.{name}") for pair, names in told for name in names]
    found = bundle.observe(RUN, moved, np.concatenate([columns, seen]).astype(np.int64))
    values = found[:, : len(columns)]
    ends = np.cumsum([len(columns), *(len(names) for _, names in told)])
    contacts = [_entering(found[:, a:b].T) for a, b in pairwise(ends)]
    depth, rate = np.array(contacts).reshape(len(told), 2, len(moved)).transpose(1, 2, 0)
    entered = (depth > 0.0) & (moved[:, row.mode : row.impact_rate] <= 0.0)
    again = entered.any(axis=1)
    if again.any():
        latched = np.maximum(rate, bundle.lane(RUN)["impact_floor"])
        np.copyto(moved[:, row.mode : row.impact_rate], 1.0, where=entered)
        np.copyto(moved[:, row.impact_rate : row.width], latched, where=entered)
        values[again] = bundle.observe(RUN, moved[again], columns)
    return values


def _entering(contact: Floats) -> tuple[Floats, Floats]:
    """Return depth, m, and the magnitude of its rate, m/s, from rows of `CONTACT` or `WALL`."""
    if len(contact) == len(WALL):
        return contact[0], np.abs(contact[1])
    depth, ex, ey, vx, vy = contact
    with np.errstate(invalid="ignore"):  # a journal at the centre of its bearing enters nothing
        return depth, np.abs(ex * vx + ey * vy) / np.sqrt(ex * ex + ey * ey)
