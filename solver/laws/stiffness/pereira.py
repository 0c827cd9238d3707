"""The enhanced cylindrical contact of Pereira, Ramalho and Ambrosio."""

from typing import ClassVar, Literal

from jointplay.solver.laws.fit import Fit
from jointplay.solver.laws.stiffness.material import OfWidth
from jointplay.solver.laws.stiffness.power import power_energy, power_slope
from jointplay.solver.quantities.scalars import (
    Scalar,
    exponential,
    logarithm,
    maximum,
    positive_part,
    power,
    select_positive,
)
from jointplay.solver.quantities.units import Rule

MILLIMETRES = 1e3
"""Millimetres in a metre: the law's numbers are in millimetres and newtons."""
LEAST, BREAK, MOST = 0.005, 0.34954, 10.0
"""Clearances (mm) from which, and up to which, the law was fitted; where its exponent changes."""


class Pereira(OfWidth):
    """F = (0.965 ΔR + 0.0965) L E* / ΔR δ^n, n = Y ΔR^-0.005, in millimetres and newtons.

    Y = 1.51 ln(1000 ΔR)^-0.151 for clearances ΔR from 5 µm to 0.34954 mm, and 0.0151 ΔR + 1.151 up
    to 10 mm; internal contact. The depth δ and the width L are in mm there, E* in N/mm², with
    1 / E* = 2 (1 - ν²) / E.

    Assumes steel on steel, to which it was fitted (against Johnson's law). Fails outside of the
    range of clearances, and for a law of physics: its dimensions depend on the clearance.

    Source: Pereira, Ramalho and Ambrosio 2014, Nonlinear Dyn. 78.
    """

    law: Literal["pereira"] = "pereira"
    fit_rules: ClassVar[tuple[Rule, ...]] = (
        *OfWidth.fit_rules,
        Rule(
            "radial_clearance",
            lambda clearance: (
                (clearance.radial_clearance > 0.0)
                & (clearance.radial_clearance < LEAST / MILLIMETRES)
                | (clearance.radial_clearance > MOST / MILLIMETRES)
            ),
            lambda clearance: (
                f"The stiffness law 'pereira' holds for radial clearances from 5e-06 to 0.01 m, not"
                f" for {clearance.radial_clearance:g} m; choose another law."
            ),
        ),
    )

    def exponent_for(self, fit: Fit) -> Scalar:
        """Return n."""
        clearance = MILLIMETRES * fit.radial_clearance
        logarithmic = logarithm(1e3 * maximum(clearance, LEAST))
        narrow = 1.51 * exponential(-0.151 * logarithm(logarithmic))
        wide = 0.0151 * clearance + 1.151
        factor = select_positive(clearance - BREAK, wide, narrow)
        return factor * exponential(-0.005 * logarithm(clearance))

    def force(self, fit: Fit, depth: Scalar) -> Scalar:
        """Return F, N."""
        clearance = MILLIMETRES * fit.radial_clearance
        modulus = self.effective_modulus / (MILLIMETRES * MILLIMETRES)
        line = (0.965 * clearance + 0.0965) / clearance * modulus
        stiffness = line * (MILLIMETRES * fit.bearing_width)
        return stiffness * power(positive_part(MILLIMETRES * depth), self.exponent_for(fit))

    def energy(self, fit: Fit, depth: Scalar) -> Scalar:
        """Return F δ / (n + 1), J."""
        return power_energy(self.force(fit, depth), depth, self.exponent_for(fit))

    def slope(self, fit: Fit, depth: Scalar) -> Scalar:
        """Return n F / δ, N/m."""
        return power_slope(self.force(fit, depth), depth, self.exponent_for(fit))
