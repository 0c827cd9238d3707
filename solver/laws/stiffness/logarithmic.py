"""The equation behind the laws that give the depth of a line contact as a logarithm of its load.

δ = a F (ln(b / F) + c) is what Johnson, Radzimovsky, Goldsmith, Dubowsky and Freudenstein, and
ESDU 78035 print, each with other constants. With u = ln(b / F) + c it reads F = δ / (a u),

    u - ln u = t,  t = ln(D / δ),  D = a b e^c,

whose branch u > 1 is the one on which the load grows with the depth (u = -W_-1(-e^-t), Lambert's
function). Three rounds of Newton's rule reach it to rounding, without a branch.

The depth has a largest value, at u = 1, where the slope dF/dδ = 1 / (a (u - 1)) is infinite: no
load beyond exists. So the logarithm is followed up to u = 2, 0.74 of that depth; from there on the
force goes on along its tangent, so that a deep impact has a finite force that grows.
"""

import math
from abc import abstractmethod
from typing import NamedTuple

from jointplay.solver.laws.fit import Fit
from jointplay.solver.laws.stiffness.material import OfWidth
from jointplay.solver.quantities.scalars import (
    Scalar,
    exponential,
    logarithm,
    maximum,
    minimum,
    positive_part,
    select_positive,
    sqrt,
)

LAST = 2.0
"""u at the depth where the tangent takes over."""
LAST_T = LAST - logarithm(LAST)
ROUNDS = 3
SMALLEST = 1e-300
"""Depth (m) below which the logarithm changes no more."""


class Constants(NamedTuple):
    """Constants of δ = a F (ln(b / F) + c)."""

    a: Scalar
    """m/N."""
    b: Scalar
    """N."""
    c: float


def lower_branch(t: Scalar) -> Scalar:
    """Return u > 1 with u - ln u = t, to rounding, for t of at least 2 - ln 2."""
    u = t + logarithm(1.0 + sqrt(2.0 * (t - 1.0)) + 2.0 / 3.0 * (t - 1.0))  # to 1 %
    for _ in range(ROUNDS):
        u = u * (t + logarithm(u) - 1.0) / (u - 1.0)
    return u


class Logarithmic(OfWidth):
    """A stiffness that solves δ = a F (ln(b / F) + c)."""

    @abstractmethod
    def constants(self, fit: Fit) -> Constants:
        """Return a, b and c."""

    def deepest(self, fit: Fit) -> Scalar:
        """Return the depth at u = 2, m; without a width there is none."""
        if fit.bearing_width is None:
            return math.inf
        a, b, c = self.constants(fit)
        return a * b * exponential(c - LAST_T)

    def force(self, fit: Fit, depth: Scalar) -> Scalar:
        """Return F, N; along its tangent beyond `deepest`."""
        a, u, within, beyond = self._solved(fit, depth)
        return within / (a * u) + beyond / a

    def energy(self, fit: Fit, depth: Scalar) -> Scalar:
        """Return F δ - a F² (ln(b / F) + c + 1/2) / 2, J."""
        a, u, within, beyond = self._solved(fit, depth)
        force = within / (a * u)
        return force * within * (0.5 - 0.25 / u) + beyond * (force + 0.5 * beyond / a)

    def slope(self, fit: Fit, depth: Scalar) -> Scalar:
        """Return 1 / (a (u - 1)), N/m."""
        a, u, _, _ = self._solved(fit, depth)
        return select_positive(depth, 1.0 / (a * (u - 1.0)), 0.0)

    @property
    def is_stiff_at_once(self) -> bool:
        """True always: the slope vanishes as 1 / ln δ only."""
        return True

    def _solved(self, fit: Fit, depth: Scalar) -> tuple[Scalar, Scalar, Scalar, Scalar]:
        """Return a, u, and the depth within the logarithm and beyond it."""
        a, b, c = self.constants(fit)
        deep = positive_part(depth)
        within = minimum(deep, self.deepest(fit))
        scale = a * b * exponential(c)
        return a, lower_branch(logarithm(scale / maximum(within, SMALLEST))), within, deep - within
