"""A polynomial for each piece between knots."""

import math
from typing import Annotated, Any, ClassVar, Literal

import numpy as np
from numpy.polynomial import Polynomial as Numeric
from pydantic import Field

from jointplay.solver.laws.function.knots import (
    BENDS,
    GROWING,
    Knots,
    Outside,
    brought_inside,
    least_gap,
    noted,
)
from jointplay.solver.laws.function.law import SMOOTH, Derivatives, Function
from jointplay.solver.laws.function.polynomial import Coefficient, derivatives, largest_magnitudes
from jointplay.solver.quantities.scalars import Scalar, maximum, select_positive
from jointplay.solver.quantities.units import Rule

TOLERANCE = 1e-9
"""Share of the largest coefficient's part up to which a jump at a knot is rounding."""

Pieces = Annotated[
    list[Annotated[list[Coefficient], Field(min_length=1, max_length=8)]],
    Field(min_length=1, max_length=63),
]


def _jump(function: Any, order: int) -> Any:
    """Return the largest jump of a derivative at knots, as a share of what it is made of.

    Where it repeats, the ends are a knot; where its ends are held, slopes jump to zero there.
    """
    starts, ends, size = [], [], 1e-300
    for k, piece in enumerate(function.coefficients):
        width = function.knots[k + 1] - function.knots[k]
        factors = [math.perm(n, order) * c for n, c in enumerate(piece)][order:]
        parts = [factor * width**n for n, factor in enumerate(factors)] or [0.0 * width]
        starts.append(parts[0])
        ends.append(sum(parts))
        size = np.maximum(size, sum(np.abs(part) for part in parts))
    pairs = list(zip(ends, starts[1:], strict=False))
    if function.outside == "periodic":
        pairs.append((ends[-1], starts[0]))
    elif function.outside == "held" and order > 0:
        pairs += [(0.0, starts[0]), (ends[-1], 0.0)]
    largest: Any = 0.0
    for before, after in pairs:
        largest = np.maximum(largest, np.abs(after - before))
    return largest / size


def _fits(function: Any) -> bool:
    return len(function.coefficients) == len(function.knots) - 1


class PiecewisePolynomial(Function):
    """f(x) = c_k0 + c_k1 t + c_k2 t² + ..., t = x less the knot k before, at most of degree 7.

    Pieces must meet. Outside of the knots ``held`` keeps the end values, ``periodic`` repeats, and
    ``refused`` ends the run there.

    Assumes coefficients to all digits: a jump at a knot of more than 1e-9 is refused. Fails to
    move a joint where slopes jump at a knot.

    Source: the definition of a polynomial.
    """

    type: Literal["piecewise-polynomial"]
    knots: Knots
    coefficients: Pieces
    outside: Outside
    rules: ClassVar[tuple[Rule, ...]] = (
        *GROWING,
        Rule(
            "coefficients",
            lambda function: not _fits(function),
            lambda function: (
                f"There are {len(function.coefficients)} polynomials for {len(function.knots)}"
                f" knots; give {len(function.knots) - 1}, one between any two."
            ),
        ),
        Rule(
            "coefficients",
            lambda function: _jump(function, 0) > TOLERANCE if _fits(function) else False,
            lambda function: (
                f"The value jumps at a knot, by {_jump(function, 0):.3g} of its largest; let every"
                " polynomial begin where the one before ends"
                + (", and the last end where the first begins." if _repeats(function) else ".")
            ),
        ),
    )

    def at(self, x: Scalar) -> Derivatives:
        """Return value and derivatives; which polynomial is in force is chosen by comparison."""
        first, last = self.knots[0], self.knots[-1]
        inside = brought_inside(x, first, last, self.outside)
        degree = max(len(piece) for piece in self.coefficients)
        padded = [[*piece, *[0.0] * (degree - len(piece))] for piece in self.coefficients]
        chosen: list[Scalar] = [first, *padded[0]]
        for knot, piece in zip(self.knots[1:-1], padded[1:], strict=True):
            behind = inside - knot
            pairs = zip([knot, *piece], chosen, strict=True)
            chosen = [select_positive(behind, new, old) for new, old in pairs]
        found = derivatives(chosen[1:], inside - chosen[0])
        if self.outside != "held":
            return noted(found, x, self, bent=True)
        beyond = maximum(first - x, x - last)
        still = [select_positive(beyond, 0.0, part) for part in found[1:]]
        return noted(Derivatives(found.value, *still), x, self, bent=True)

    @property
    def period(self) -> float:
        """Span of one that repeats, 0 for a constant, else infinite."""
        if not any(any(piece[1:]) for piece in self.coefficients):
            return 0.0
        return self.knots[-1] - self.knots[0] if _repeats(self) else math.inf

    @property
    def bend(self) -> float:
        """Some distances of the nearest knots."""
        return BENDS * float(least_gap(self))

    @property
    def has_curvature(self) -> bool:
        """True where slopes do not jump."""
        return bool(_jump(self, 1) <= TOLERANCE)

    @property
    def domain(self) -> tuple[float, float] | None:
        """See `Function.domain`."""
        return (self.knots[0], self.knots[-1]) if self.outside == "refused" else None

    def largest(self, until: float) -> list[float]:
        """Return the largest magnitudes of any piece."""
        widths = np.diff(self.knots)
        found = [0.0] * SMOOTH
        for piece, width in zip(self.coefficients, widths, strict=True):
            for k, bound in enumerate(largest_magnitudes(Numeric(piece), float(width))):
                found[k] = max(found[k], bound)
        degree = max(len(piece) for piece in self.coefficients) - 1
        return found[: max(degree, 1)]


def _repeats(function: Any) -> bool:
    return bool(function.outside == "periodic")
