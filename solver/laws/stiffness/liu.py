"""The conformal contact of a cylinder in a cylinder of Liu, Zhang and Xu."""

import math
from typing import Literal

import numpy as np
from numpy.polynomial.legendre import leggauss

from jointplay.solver.laws.fit import Fit
from jointplay.solver.laws.stiffness.material import OfWidth
from jointplay.solver.laws.stiffness.power import NOTHING
from jointplay.solver.quantities.scalars import Scalar, positive_part, select_positive, sqrt

NODES = [(0.5 + 0.5 * x, 0.5 * w) for x, w in np.transpose(leggauss(10)).tolist()]
"""Points of Gauss's rule on 0..1: the integrand of the energy, over δ x² for the depth, is smooth;
up to depths of twice the clearance it errs by 1e-11."""


class Liu(OfWidth):
    """F = π/2 δ E* L sqrt(δ / (2 (ΔR + δ))).

    δ is the penetration depth (m), L the bearing's width, ΔR the radial clearance (m),
    1 / E* = 2 (1 - ν²) / E.

    Assumes that the half of a distributed (Winkler) pressure that supports the journal is elliptic.
    Fails at small depths, where it is far softer than line contact: 56 N for 407 N of Johnson at
    1 µm, clearance 0.5 mm.

    Source: Liu, Zhang and Xu 2007, Int. J. Mech. Sci. 49.
    """

    law: Literal["liu"] = "liu"

    def force(self, fit: Fit, depth: Scalar) -> Scalar:
        """Return F, N."""
        deep = positive_part(depth)
        half = 0.5 * math.pi * self.effective_modulus * fit.bearing_width
        return half * (deep * sqrt(deep)) / sqrt(2.0 * (fit.radial_clearance + deep))

    def energy(self, fit: Fit, depth: Scalar) -> Scalar:
        """Return the integral of F, J."""
        deep = positive_part(depth)
        total: Scalar = 0.0
        for x, weight in NODES:  # with δ x² for the depth, x^4 dx remains of δ^1.5 dδ
            total += (
                weight * ((x * x) * (x * x)) / sqrt(2.0 * (fit.radial_clearance + x * x * deep))
            )
        half = 0.5 * math.pi * self.effective_modulus * fit.bearing_width
        return 2.0 * half * (deep * deep * sqrt(deep)) * total

    def slope(self, fit: Fit, depth: Scalar) -> Scalar:
        """Return F (1.5 / δ - 0.5 / (ΔR + δ)), N/m."""
        deep = positive_part(depth)
        share = 1.5 / (deep + NOTHING) - 0.5 / (fit.radial_clearance + deep)
        return select_positive(depth, self.force(fit, depth) * share, 0.0)
