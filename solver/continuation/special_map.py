"""A special orbit as a fixed point: the section map with one parameter more, and a test function.

State and parameter (x, p) go to (P(x, p, q), p + g): a fixed point of that is an orbit at which the
test function g is 0, and its curve over the second parameter q is found as any branch is.

For a fold g is det(DP - 1), for a period doubling det(DP + 1), for a Neimark-Sacker bifurcation
that of the bialternate product of DP with itself, less 1: the minimally augmented systems of
Kuznetsov 2004, Elements of Applied Bifurcation Theory, 3rd ed., chapter 10. The tests of
`multipliers` are these polynomials of DP, products over all multipliers or pairs of them: as smooth
as DP, also where multipliers meet; one multiplier alone is not. Sections have few states, so that
no bordering is needed to keep a determinant in range.

For grazing g is how near the orbit comes to the impact that it does not have. On the other side of
grazing P has a square root, and Newton's method fails (Ghosh and Simpson 2025, arXiv 2510.16218);
so the curve is followed at a small distance on the side without the impact, where all is smooth
however hard the contact is, with differences that are smaller than that.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.continuation.multipliers import (
    Complexes,
    doubling,
    multipliers_of,
    passing_one,
    torus,
)
from jointplay.solver.continuation.passage import Linear, Section
from jointplay.solver.continuation.section_map import SectionMap
from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.linear_algebra.orthogonal import Decomposition

TESTS: dict[str, Callable[[Complexes], float]] = {
    "LP": passing_one,
    "PD": doubling,
    "NS": torus,
}
"""Test functions of multipliers, by the label of the special orbits at which they are 0."""
NEAR = 1e-3
"""Distance, in scales of states and parameters, over which a test function's slope is taken: that
of DP errs by 1e-8 of its differences, and by the square of this."""
GENTLE = 1e3
"""Value of a test function that counts as much as one in a state where Newton's method ends: DP is
known to a thousandth of the digits that runs have."""
ROUNDING = 1e-12
GRAZING = "GR"
CROSSED = "an impact begins or ends"
MARGIN = 2e-7
"""Distance from grazing, of how far the pair moves."""
FINE = 1e-3
"""Differences beside grazing, in the usual ones."""
BENT = 3.0
"""Share of the square of that distance that is added: Newton's method then comes to grazing from
the side without the impact, although the distance bends."""


@dataclass(frozen=True)
class SpecialMap:
    """The map of state and parameter whose fixed points are special orbits."""

    base: SectionMap
    """The map of sections with a second value."""
    label: str
    """One of `TESTS`, or GR."""
    extents: Floats
    """(base.size + 2,) what counts as one in states, impact rates and both parameters."""
    onsets: int = 0
    """Impacts of orbits next to grazing, without the one that begins."""

    @property
    def size(self) -> int:
        """Numbers of a section, and the parameter."""
        return self.base.size + 1

    @property
    def kernel(self) -> Kernel:
        """Kernel of the runs."""
        return self.base.kernel

    @property
    def tolerance(self) -> float:
        """Tolerance of the runs."""
        return self.base.tolerance

    @property
    def periods(self) -> int:
        """Periods of the drivers that the map lasts."""
        return self.base.periods

    def section(self, numbers: Floats) -> Section:
        """Return the section whose state, and then both parameters, are given."""
        *state, value, second = numbers.tolist()
        return Section(value, np.array(state), (second,))

    def numbers(self, section: Section) -> Floats:
        """Return state and parameters of a section, (size + 1,)."""
        return self.base.numbers(section)

    def distance(self, linear: Linear) -> float:
        """Return how far a fixed point is off: of states in their scales, or of the test."""
        *away, test = np.append(
            linear.residual[:-1] / self.base.scales, linear.residual[-1] / GENTLE
        )
        return float(np.abs([*away[: self.kernel.states], test]).max())

    def linear(self, section: Section, scale: float = 1.0) -> Linear:
        """Return the map at a section and its derivatives; of use only without a failure."""
        grazing, size = self.label == GRAZING, self.base.size
        scale *= FINE if grazing else 1.0
        (linear,) = self.base.linears([section], scale, over=2)
        rates = np.hstack([linear.jacobian, linear.sensitivity])
        passage, test, row = linear.passage, 0.0, np.zeros(size + 2)
        if grazing and not passage.failure and not (linear.alike and passage.onsets == self.onsets):
            passage = replace(passage, failure=CROSSED)
        if passage.failure:
            pass
        elif grazing:
            away = passage.nearest + MARGIN
            test = away + BENT * away * abs(away)
            row = (1.0 + 2.0 * BENT * abs(away)) * linear.nearing
        else:
            test = self._test(linear)
            beside, row = self._slope(section, scale, rates)
            failed = next((one.passage.failure for one in beside if one.passage.failure), "")
            passage = replace(passage, failure=failed)
        row = row.copy()
        row[size] += 1.0
        whole, split = np.vstack([rates, row]), size + 1
        residual = np.append(linear.residual, test)
        return Linear(
            passage,
            residual,
            whole[:, :split],
            whole[:, split:],
            linear.alike,
            linear.jacobian,
            linear.nearing,
        )

    def _test(self, linear: Linear) -> float:
        return TESTS[self.label](multipliers_of(linear.monodromy))

    def _slope(self, section: Section, scale: float, rates: Floats) -> tuple[list[Linear], Floats]:
        """Return the map beside a section, and (base.size + 2,) the test's slope from that.

        It is taken along the two directions in which orbits lie next to this one, whatever the
        number of states: steps across come to rest by the map's own rows.
        rates : (base.size, base.size + 2) derivatives of the section's end by state and parameters.
        """
        size, step = self.base.size, scale * NEAR
        residual_rates = (rates - np.eye(size, size + 2)) * self.extents / self.extents[:size, None]
        free = Decomposition(residual_rates, ROUNDING).free.T
        away = [sign * step * one * self.extents for one in free for sign in (1.0, -1.0)]
        moved = [section.moved(one[:size], *one[size:].tolist()) for one in away]
        beside = self.base.linears(moved, scale, over=0)
        slope = np.zeros(size + 2)
        if not any(one.passage.failure for one in beside):
            tests = [self._test(one) for one in beside]
            for up, down, one in zip(tests[::2], tests[1::2], free, strict=True):
                slope += (up - down) / (2.0 * step) * one
        return beside, slope / self.extents
