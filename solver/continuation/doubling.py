"""From a period doubling to the branch of twice the period."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from jointplay.solver.continuation.branch import Row
from jointplay.solver.continuation.multipliers import direction_of
from jointplay.solver.continuation.orbit import Curve, Orbit, Way
from jointplay.solver.continuation.settled import NoStart
from jointplay.solver.continuation.start import shorter_period

DISTANCES = (1e-2, 4e-3, 1.6e-3, 6.4e-4, 2.56e-4, 1.024e-4)
"""Distances from the doubling, along the branch, at which an orbit is sought."""


def behind_doubling(branch: Sequence[Row]) -> Way:
    """Return where the branch behind the first period doubling of another one begins.

    Raises
    ------
    NoStart
        There is no doubling, or no orbit was found.
    """
    row = next((row for row in branch if row.label == "PD"), None)
    if row is None:
        sentence = "The branch before has no period doubling; try a wider range, a larger 'count'"
        raise NoStart(f"{sentence} or fewer 'doublings'.")
    return _doubled(row.orbit)


def _doubled(orbit: Orbit) -> Way:
    """Return an orbit of twice the period next to a period doubling, and the way on from there."""
    map_ = orbit.curve.sections
    curve = Curve(replace(map_, periods=2 * map_.periods), orbit.curve.scales)
    extents = curve.scales.extents
    nearest = min(orbit.multipliers.real.tolist(), key=lambda one: abs(one + 1.0))
    along = direction_of(orbit.linear.jacobian, nearest) / extents[:-1]
    direction = np.append(along, 0.0)
    direction /= curve.scales.length(direction)
    for distance in DISTANCES:
        for sense in (1.0, -1.0):
            guess = orbit.vector + sense * distance * direction
            found = curve.orbit(guess, direction)
            if isinstance(found, Orbit) and not shorter_period(found):
                return found, sense * direction
    raise NoStart(
        f"No orbit of {curve.map.periods} periods was found next to the period doubling at"
        f" {orbit.value:.9g}, down to {DISTANCES[-1]:.2g} from it; try a smaller tolerance."
    )
