"""From a period doubling to the branch of twice the period."""

from dataclasses import replace

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.continuation.multipliers import direction_of
from jointplay.solver.continuation.orbit import Curve, Orbit
from jointplay.solver.continuation.start import NoStart, shorter_period

FIRST, SHRINK, TRIES = 0.01, 0.4, 6
"""Distances from the doubling, along the branch, at which an orbit is sought."""


def doubled(orbit: Orbit) -> tuple[Orbit, Floats]:
    """Return an orbit of twice the period next to a period doubling, and the way on from there.

    Raises
    ------
    NoStart
        None was found.
    """
    curve = Curve(replace(orbit.curve.map, periods=2 * orbit.curve.map.periods), orbit.curve.scales)
    extents = curve.scales.extents
    nearest = min(orbit.multipliers.real.tolist(), key=lambda one: abs(one + 1.0))
    along = direction_of(orbit.linear.jacobian, nearest) / extents[:-1]
    direction = np.append(along, 0.0)
    direction /= curve.scales.length(direction)
    distance = FIRST
    for _ in range(TRIES):
        for sense in (1.0, -1.0):
            guess = orbit.vector + sense * distance * direction
            found = curve.orbit(guess, direction)
            if isinstance(found, Orbit) and not shorter_period(found):
                return found, sense * direction
        distance *= SHRINK
    raise NoStart(
        f"No orbit of {curve.map.periods} periods was found next to the period doubling at"
        f" {orbit.value:.9g}, down to {distance:.2g} from it; try a smaller tolerance."
    )
