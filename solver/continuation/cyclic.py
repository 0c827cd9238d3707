"""Cyclic coordinates: those on which nothing depends, so that an orbit may come back elsewhere.

The place of a mechanism that travels is one (Goldstein 1980, Classical Mechanics, 2.6). Its motion
is periodic but for that: moved along the coordinate, an orbit is another one.
"""

from dataclasses import replace

import numpy as np

from jointplay.solver.continuation.passage import Section
from jointplay.solver.continuation.section_map import DIFFERENCE, SectionMap

SAME = 1e-6
"""Distance, in the scales of the states, within which a coordinate has come back."""
ALIKE = 1e-3
"""Share of a step along a coordinate within which the ends of runs are as far apart."""
FAR = 1.0
"""Distance, rad or m, by which a run is moved along what seems to be one. The unit does not matter:
nothing depends on a cyclic coordinate. It tells what begins farther away than a small move goes."""


def with_cyclic(map_: SectionMap, section: Section) -> SectionMap:
    """Return a map that knows which coordinates are cyclic, of those that the motion leaves.

    A coordinate is if a run from a section that is moved along it, by a little and by much, ends
    moved by as much, and alike in all others.
    """
    (passage,) = map_.passages([section])
    if passage.failure:
        return map_
    away = np.abs(map_.away(passage.end, section.state) / map_.scales)[
        : len(map_.kernel.coordinates)
    ]
    found = np.flatnonzero(away > SAME).tolist()
    for steps in (DIFFERENCE * map_.scales, np.full(map_.size, FAR)):
        moves = steps * np.eye(map_.size)[found]
        runs = map_.passages([section.moved(move) for move in moves]) if found else []
        nearest = (ALIKE * np.minimum(steps, map_.scales))[: map_.kernel.states]
        alike = [
            not run.failure
            and bool(np.all(np.abs(run.end - passage.end - move)[: len(nearest)] < nearest))
            for run, move in zip(runs, moves, strict=True)
        ]
        found = [k for k, one in zip(found, alike, strict=True) if one]
    return replace(map_, cyclic=tuple(found))
