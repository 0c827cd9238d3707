"""Cubics between knots, from values and slopes there (Hermite), and how slopes are chosen.

On abstract scalars: where knots and values are numbers of a scene, all coefficients are computed
once a run.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

from jointplay.solver.laws.function.law import Derivatives
from jointplay.solver.quantities.scalars import Scalar, select_positive


@dataclass(frozen=True)
class Cubics:
    """f = a + t (b + t (c + t d)) with t = x less the knot before, from n knots."""

    knots: Sequence[Scalar]
    values: Sequence[Scalar]
    slopes: Sequence[Scalar]

    def pieces(self) -> list[tuple[Scalar, Scalar, Scalar, Scalar, Scalar]]:
        """Return knot, a, b, c and d of every piece."""
        found = []
        widths, secants = _secants(self.knots, self.values)
        for k, (width, secant) in enumerate(zip(widths, secants, strict=True)):
            left, right = self.slopes[k], self.slopes[k + 1]
            c = (3.0 * secant - 2.0 * left - right) / width
            d = (left + right - 2.0 * secant) / (width * width)
            found.append((self.knots[k], self.values[k], left, c, d))
        return found

    def at(self, x: Scalar) -> Derivatives:
        """Return value and derivatives at an argument between the first and the last knot."""
        chosen, *rest = self.pieces()
        for piece in rest:
            behind = x - piece[0]
            pairs = zip(piece, chosen, strict=True)
            chosen = tuple(select_positive(behind, new, old) for new, old in pairs)
        knot, a, b, c, d = chosen
        t = x - knot
        cubic = 3.0 * d
        return Derivatives(
            a + t * (b + t * (c + t * d)), b + t * (2.0 * c + t * cubic), 2.0 * (c + t * cubic)
        )

    def largest(self) -> list[float]:
        """Return the largest magnitudes of slope, second and third derivative; of floats alone."""
        slope = curvature = third = 0.0
        widths, _ = _secants(self.knots, self.values)
        for width, (_, _, b, c, d) in zip(widths, self.pieces(), strict=True):
            turn = min(max(-c / (3.0 * d), 0.0), width) if d != 0.0 else 0.0
            for t in (0.0, turn, width):
                slope = max(slope, abs(b + t * (2.0 * c + 3.0 * d * t)))
                curvature = max(curvature, abs(2.0 * c + 6.0 * d * t))
            third = max(third, abs(6.0 * d))
        return [slope, curvature, third]

    def beyond(self) -> tuple[float, float]:
        """Return how far f passes both values of a piece, at most, and where; of floats alone."""
        found = (0.0, float(self.knots[0]))
        widths, _ = _secants(self.knots, self.values)
        for width, (knot, a, b, c, d), end in zip(
            widths, self.pieces(), self.values[1:], strict=True
        ):
            for t in _turns(b, 2.0 * c, 3.0 * d):
                if 0.0 < t < width:
                    value = a + t * (b + t * (c + t * d))
                    passed = max(value - max(a, end), min(a, end) - value)
                    found = max(found, (passed, knot + t))
        return found


def _turns(a: float, b: float, c: float) -> list[float]:
    """Return where a + b t + c t² is zero, by the form that cancels nothing."""
    root = b * b - 4.0 * a * c
    if root < 0.0:
        return []
    half = -0.5 * (b + math.copysign(math.sqrt(root), b))
    return [top / bottom for top, bottom in ((half, c), (a, half)) if bottom != 0.0]


def _secants(
    knots: Sequence[Scalar], values: Sequence[Scalar]
) -> tuple[list[Scalar], list[Scalar]]:
    """Return the widths between knots and the slopes of straight lines there."""
    widths = [after - before for before, after in pairwise(knots)]
    rises = [after - before for before, after in pairwise(values)]
    return widths, [rise / width for rise, width in zip(rises, widths, strict=True)]


def smooth_slopes(
    knots: Sequence[Scalar], values: Sequence[Scalar], *, periodic: bool
) -> list[Scalar]:
    """Return the slopes of the cubic spline, zero at the ends unless it is periodic.

    At knot k, m_{k-1}/h_{k-1} + 2 (1/h_{k-1} + 1/h_k) m_k + m_{k+1}/h_k = 3 (s_{k-1}/h_{k-1} +
    s_k/h_k), with widths h and secants s.
    """
    widths, secants = _secants(knots, values)
    inverse = [1.0 / width for width in widths]
    around = [3.0 * (s * w) for s, w in zip(secants, inverse, strict=True)]
    inner = range(1, len(widths))
    diagonal = [2.0 * (inverse[k - 1] + inverse[k]) for k in inner]
    right = [around[k - 1] + around[k] for k in inner]
    beside = inverse[1:-1]
    if not periodic:
        return [0.0, *_tridiagonal(diagonal, beside, right), 0.0]
    # the slope m at both ends: inner slopes are u - m w, and the row of the end knot gives m
    ends = [0.0] * len(diagonal)
    if ends:
        ends[0] = ends[0] + inverse[0]
        ends[-1] = ends[-1] + inverse[-1]
    u, w = _tridiagonal(diagonal, beside, right), _tridiagonal(diagonal, beside, ends)
    row, total = 2.0 * (inverse[0] + inverse[-1]), around[0] + around[-1]
    if ends:
        row = row - inverse[0] * w[0] - inverse[-1] * w[-1]
        total = total - inverse[0] * u[0] - inverse[-1] * u[-1]
    else:  # one piece, whose ends are one knot: the row couples it with itself
        row = row + 2.0 * inverse[0]
    m = total / row
    return [m, *(a - m * b for a, b in zip(u, w, strict=True)), m]


def _tridiagonal(
    diagonal: Sequence[Scalar], beside: Sequence[Scalar], right: Sequence[Scalar]
) -> list[Scalar]:
    """Solve a symmetric system whose diagonal dominates (Thomas' algorithm)."""
    pivots, moved = list(diagonal), list(right)
    for k in range(1, len(pivots)):
        factor = beside[k - 1] / pivots[k - 1]
        pivots[k] = pivots[k] - factor * beside[k - 1]
        moved[k] = moved[k] - factor * moved[k - 1]
    for k in reversed(range(len(pivots))):
        if k + 1 < len(pivots):
            moved[k] = moved[k] - beside[k] * moved[k + 1]
        moved[k] = moved[k] / pivots[k]
    return moved


def steady_slopes(
    knots: Sequence[Scalar], values: Sequence[Scalar], *, periodic: bool
) -> list[Scalar]:
    """Return slopes that let the cubics rise and fall only where the values do.

    Between secants s and t of widths g and h of one sign, 3 (g + h) / ((2h + g)/s + (h + 2g)/t);
    else zero, as at the ends unless the table is periodic.
    """
    widths, secants = _secants(knots, values)

    def mean(before: int, after: int) -> Scalar:
        (g, h), (s, t) = (widths[before], widths[after]), (secants[before], secants[after])
        both = s * t
        divisor = (2.0 * h + g) * t + (h + 2.0 * g) * s
        alike = 3.0 * (g + h) * both / select_positive(both, divisor, 1.0)
        return select_positive(both, alike, 0.0)

    inner = [mean(k - 1, k) for k in range(1, len(widths))]
    end = mean(-1, 0) if periodic else 0.0
    return [end, *inner, end]
