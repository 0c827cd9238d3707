"""A table of values, with a cubic between any two of them."""

import math
from typing import Annotated, ClassVar, Literal, Self

from pydantic import Field

from jointplay.solver.laws.function.cubics import Cubics, smooth_slopes, steady_slopes
from jointplay.solver.laws.function.knots import (
    BENDS,
    GROWING,
    MOST_KNOTS,
    Knots,
    Outside,
    brought_inside,
    least_gap,
    noted,
)
from jointplay.solver.laws.function.law import Between, Derivatives, Function
from jointplay.solver.quantities.scalars import Scalar, maximum, select_positive
from jointplay.solver.quantities.units import Rule, quantity

Values = Annotated[
    list[Annotated[float, quantity("unit of the value", ge=-1e12, le=1e12)]],
    Field(min_length=2, max_length=MOST_KNOTS),
]


class Table(Function):
    """f through given values at given knots, a cubic between two of them (Hermite's form).

    ``monotone``: the slopes are weighted harmonic means of those on either side, zero where they
    differ in sign, so that f stays between neighbouring values, and the second derivative jumps at
    knots. ``smooth``: the slopes make the second derivative continuous (cubic spline). The course
    of a force is monotone if nothing is said, a motion and the profile of a cam are smooth.
    Outside of the knots ``held`` keeps the end values; ``periodic`` repeats the table, whose last
    value must be its first; ``refused`` ends the run there. Ends have no slope, unless it repeats.

    Assumes knots closer than the values bend. Fails to stay within its values where it is smooth
    and they have corners: it overshoots them, and a dwell bulges, by as much as `jointplay scene
    check` tells. Where it is monotone it moves no joint, for accelerations would jump.

    Source: de Boor 1978, A Practical Guide to Splines, chapter IV; Fritsch and Butland 1984, SIAM
    Journal on Scientific and Statistical Computing 5:300, with Brodlie's weights, those of SLATEC's
    DPCHIM and of SciPy's PchipInterpolator.
    """

    type: Literal["table"]
    knots: Knots
    values: Values
    between: Annotated[
        Between | None,
        Field(
            description="none: 'monotone' in the course of a force, 'smooth' in a motion and in the"
            " profile of a cam"
        ),
    ] = None
    outside: Outside
    rules: ClassVar[tuple[Rule, ...]] = (
        *GROWING,
        Rule(
            "values",
            lambda table: len(table.values) != len(table.knots),
            lambda table: (
                f"There are {len(table.values)} values for {len(table.knots)} knots; give one a"
                " knot."
            ),
        ),
        Rule(
            "values",
            lambda table: (
                (table.outside == "periodic") & (table.values[0] != table.values[-1])
                if len(table.values) == len(table.knots)
                else False
            ),
            lambda table: (
                f"A periodic table ends as it begins: its first value is {table.values[0]:g}, its"
                f" last {table.values[-1]:g}. Make them equal."
            ),
        ),
    )

    def at(self, x: Scalar) -> Derivatives:
        """Return value and derivatives; which cubic is in force is chosen by comparison."""
        first, last = self.knots[0], self.knots[-1]
        found = self._cubics.at(brought_inside(x, first, last, self.outside))
        bent = self.between != "smooth" or self.outside == "held"
        if self.outside != "held":
            return noted(found, x, self, bent=bent)
        # the slope is zero at the ends, the curvature of a cubic need not be
        beyond = maximum(first - x, x - last)
        still = select_positive(beyond, 0.0, found.curvature)
        return noted(found._replace(curvature=still), x, self, bent=bent)

    @property
    def _cubics(self) -> Cubics:
        slopes = smooth_slopes if self.between == "smooth" else steady_slopes
        found = slopes(self.knots, self.values, periodic=self.outside == "periodic")
        return Cubics(self.knots, self.values, found)

    @property
    def period(self) -> float:
        """Span of a periodic table; infinite for one that is held, unless all values are equal."""
        if max(self.values) == min(self.values):
            return 0.0
        return self.knots[-1] - self.knots[0] if self.outside == "periodic" else math.inf

    @property
    def bend(self) -> float:
        """Some distances of the nearest knots."""
        return BENDS * float(least_gap(self))

    @property
    def has_curvature(self) -> bool:
        """True where it is smooth."""
        return self.between == "smooth"

    @property
    def domain(self) -> tuple[float, float] | None:
        """See `Function.domain`."""
        return (self.knots[0], self.knots[-1]) if self.outside == "refused" else None

    def largest(self, until: float) -> list[float]:
        """Return the largest magnitudes of slope, second and third derivative anywhere."""
        return self._cubics.largest()

    def overshoot(self) -> tuple[float, float]:
        """See `Function.overshoot`."""
        if self.between != "smooth":
            return 0.0, math.nan
        beyond, at = self._cubics.beyond()
        span = max(self.values) - min(self.values)
        return (beyond / span if span > 0.0 else 0.0), at

    def used(self, between: Between) -> Self:
        """See `Function.used`."""
        return self if self.between else self.model_copy(update={"between": between})
