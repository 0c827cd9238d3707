"""Whether orbits of twice the period are born stable: the cubic coefficient of a doubling.

Next to an orbit with the multiplier -1, along x + xi q + xi^2 w / 2, the section map is
xi -> -xi + b xi^3 + ..., where A q = -q, p A = -p, (p, q) = 1, w = (1 - A)^-1 B(q, q) and
6 b = (p, C(q, q, q) + 3 B(q, w)) with the derivatives A, B and C of the map (Kuznetsov 2004,
Elements of Applied Bifurcation Theory, 3rd ed., section 5.4). Where b > 0 orbits of twice the
period are born stable, beside one that loses its stability: the doubling is soft. Where b < 0 they
are unstable and lie on the other side: it is hard, and motion jumps away.

B(q, q) is taken from the even part of the map on both sides of the orbit. Of its odd part along
that curve the share that grows with xi, the multiplier, cancels between two distances.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.linalg import LinAlgError

from jointplay.records.arrays import Floats
from jointplay.solver.continuation.multipliers import CRITICAL, direction_of
from jointplay.solver.continuation.passage import Linear, Section
from jointplay.solver.continuation.section_map import SectionMap
from jointplay.solver.linear_algebra.elimination import solve

DISTANCE = 1e-2
"""Largest distance from the orbit, in its extents. Through impacts at 1e11 N/m^1.5 it leaves an
error of 1e-3 of b, which changes by 0.4 within 1 rad/s; noise of runs is as much at a third of it.
"""
UNKNOWN = (math.nan, math.nan)


@dataclass(frozen=True)
class Surroundings:
    """The map next to an orbit that doubles its period, in the orbit's extents."""

    sections: SectionMap
    section: Section
    linear: Linear
    """Derivatives by the states, of the sections alone."""
    extents: Floats
    """(size,)."""

    def ends(self, away: Floats) -> Floats:
        """Return where sections, (count, size) away from the orbit's, come to; NaN: they fail.

        Those with another number of impacts fail, too.
        """
        moved = [self.section.moved(one * self.extents) for one in away]
        found = np.full(away.shape, math.nan)
        for k, passage in enumerate(self.sections.passages(moved)):
            if not passage.failure and passage.onsets == self.linear.passage.onsets:
                found[k] = away[k] + self.sections.away(passage.end, moved[k].state) / self.extents
        return found


def cubic_coefficient(near: Surroundings) -> tuple[float, float]:
    """Return b, and its error by how far two distances are apart.

    What is of second order in the distance is taken from b. Both are NaN where a run from a section
    beside fails, or where b has a pole: a second multiplier is 1 or -1.
    """
    size = len(near.extents)
    jacobian = near.linear.monodromy * near.extents / near.extents[:, None]
    middle = near.linear.residual[:size] / near.extents
    far = (DISTANCE, 0.5 * DISTANCE)
    try:
        q, p = (direction_of(one, CRITICAL["PD"]) for one in (jacobian, jacobian.T))
        ends = near.ends(np.array([sign * one * q for one in far for sign in (1.0, -1.0)]))
        even = [ends[2 * k] + ends[2 * k + 1] - 2.0 * middle for k in (0, 1)]
        bent = [solve(np.eye(size) - jacobian, one) for one in even]
        along = 2.0 * float(np.sum(p * q))
    except LinAlgError:
        return UNKNOWN
    if along == 0.0 or not np.abs(bent).max() <= 2.0 * DISTANCE:
        return UNKNOWN
    places = [
        share * sign * one * q + 0.5 * share * share * w
        for one, w in zip(far, bent, strict=True)
        for share in (1.0, 0.5)
        for sign in (1.0, -1.0)
    ]
    ends = near.ends(np.array(places))
    odd = [float(np.sum(p * (ends[k] - ends[k + 1]))) for k in range(0, len(places), 2)]
    coarse, fine = (
        (odd[2 * k] - 2.0 * odd[2 * k + 1]) / (0.75 * along * one * one * one)
        for k, one in enumerate(far)
    )
    return (4.0 * fine - coarse) / 3.0, abs(fine - coarse)
