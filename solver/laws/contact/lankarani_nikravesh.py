"""Hertz contact with Lankarani-Nikravesh damping: the paper's eqs 8-10."""

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from jointplay.solver.laws.contact.law import ContactLaw, Fit
from jointplay.solver.quantities.scalars import Scalar, positive_part, power, sqrt
from jointplay.solver.quantities.units import Rule


class LankaraniNikravesh(ContactLaw):
    """F_n = K δ^n + D δ̇ with D = 3 K (1 - c_e^2) δ^n / (4 δ̇⁻), never pulling.

    δ is the penetration depth (m), δ̇ its rate (positive while approaching, m/s), δ̇⁻ the rate at
    the onset of this contact (impact rate), c_e the restitution coefficient, K the stiffness.

    Without a given stiffness eq. 9 supplies it:
    K = 4 / (3 (h_i + h_j)) sqrt(R_i R_j / (R_i - R_j)), h = (1 - ν²) / E, both parts of one
    material. Eq. 9 is Hertz's law for spheres: it ignores the bearing's width, and tends to zero
    with the clearance growing.

    Assumes short, nearly elastic impacts. Fails for small c_e, where the restitution delivered is
    far above the one asked (0.725 for 0.5, 0.913 for 0.9), and in lasting contact, where
    1 / δ̇⁻ of the last onset scales the damping.

    Source: Lankarani and Nikravesh 1990, as printed in the press paper (Meccanica 2022), eqs 8-10.
    """

    law: Literal["lankarani-nikravesh"] = "lankarani-nikravesh"
    stiffness: Annotated[
        float | None,
        Field(gt=0.0, le=1e18, description="K; none: eq. 9", json_schema_extra={"unit": "N/m^n"}),
    ] = None
    youngs_modulus: Annotated[float, Field(gt=0.0, le=1e15, json_schema_extra={"unit": "Pa"})] = (
        2.07e11
    )
    poisson_ratio: Annotated[float, Field(ge=0.0, lt=0.5, json_schema_extra={"unit": "1"})] = 0.29
    exponent: Annotated[
        float, Field(ge=1.0, le=3.0, json_schema_extra={"unit": "1", "structural": [1.5]})
    ] = 1.5
    restitution: Annotated[float, Field(ge=0.0, le=1.0, json_schema_extra={"unit": "1"})] = 0.9
    impact_rate_floor: Annotated[
        float,
        Field(
            gt=0.0,
            le=1e3,
            description="smallest impact rate that the damping divides by",
            json_schema_extra={"unit": "m/s"},
        ),
    ] = 1e-3

    rules: ClassVar[tuple[Rule, ...]] = (
        Rule(
            "exponent",
            lambda law: (law.exponent != 1.5) & (law.stiffness is None),
            lambda _law: (
                "Eq. 9 gives a stiffness for the exponent 1.5 only; with another exponent give a"
                " stiffness (N/m^n)."
            ),
        ),
    )

    def contact_stiffness(self, fit: Fit) -> Scalar:
        """Return K, N/m^n: as given, or of eq. 9 for a journal of radius R_j = R_i - c."""
        if self.stiffness is not None:
            return self.stiffness
        compliance = (1.0 - self.poisson_ratio * self.poisson_ratio) / self.youngs_modulus
        journal_radius = fit.bearing_radius - fit.radial_clearance
        radii = fit.bearing_radius * journal_radius / fit.radial_clearance
        return 4.0 / (3.0 * (compliance + compliance)) * sqrt(radii)  # eq. (9)

    def elastic_force(self, fit: Fit, depth: Scalar) -> Scalar:
        """Return K δ^n, N."""
        return self.contact_stiffness(fit) * power(positive_part(depth), self.exponent)

    def normal_force(self, fit: Fit, depth: Scalar, rate: Scalar, impact_rate: Scalar) -> Scalar:
        """Return F_n of eqs (8) and (10), N."""
        elastic = self.elastic_force(fit, depth)
        hysteresis = 0.75 * (1.0 - self.restitution * self.restitution)
        return positive_part(elastic * (1.0 + hysteresis * rate / impact_rate))

    def elastic_energy(self, fit: Fit, depth: Scalar) -> Scalar:
        """Return K δ^(n+1) / (n + 1), J."""
        return self.elastic_force(fit, depth) * positive_part(depth) / (self.exponent + 1.0)

    @property
    def least_impact_rate(self) -> float:
        """The floor, m/s."""
        return self.impact_rate_floor
