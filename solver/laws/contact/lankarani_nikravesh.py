"""Hertz contact with Lankarani-Nikravesh damping: the paper's eqs 8-10."""

from typing import Annotated, ClassVar, Literal

from jointplay.solver.laws.contact.law import ContactLaw
from jointplay.solver.laws.dissipation.lankarani_nikravesh import LankaraniNikraveshDamping
from jointplay.solver.laws.dissipation.latched import ImpactRateFloor
from jointplay.solver.laws.dissipation.law import Elastic, Restitution
from jointplay.solver.laws.fit import Fit
from jointplay.solver.laws.stiffness.hertz_spheres import HertzSpheres
from jointplay.solver.laws.stiffness.material import PoissonRatio, YoungsModulus
from jointplay.solver.laws.stiffness.power import Power
from jointplay.solver.quantities.scalars import Scalar, positive_part
from jointplay.solver.quantities.units import Rule, quantity


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
        float | None, quantity("N/m^n", gt=0.0, le=1e18, description="K; none: eq. 9")
    ] = None
    youngs_modulus: YoungsModulus = 2.07e11
    poisson_ratio: PoissonRatio = 0.29
    exponent: Annotated[float, quantity("1", ge=1.0, le=3.0, structural=[1.5])] = 1.5
    restitution: Restitution = 0.9
    impact_rate_floor: ImpactRateFloor = None

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
        elastic = self._stiffness
        return elastic.coefficient(fit) if isinstance(elastic, HertzSpheres) else elastic.stiffness

    def normal_force(self, fit: Fit, depth: Scalar, rate: Scalar, impact_rate: Scalar) -> Scalar:
        """Return F_n of eqs (8) and (10), N."""
        damping = LankaraniNikraveshDamping.model_construct(restitution=self.restitution)
        elastic = Elastic(self._stiffness, fit, depth)
        return positive_part(damping.normal_force(elastic, rate, impact_rate))

    def elastic_energy(self, fit: Fit, depth: Scalar) -> Scalar:
        """Return K δ^(n+1) / (n + 1), J."""
        return self._stiffness.energy(fit, depth)

    @property
    def _stiffness(self) -> HertzSpheres | Power:
        if self.stiffness is not None:
            return Power.model_construct(stiffness=self.stiffness, exponent=self.exponent)
        return HertzSpheres.model_construct(
            youngs_modulus=self.youngs_modulus, poisson_ratio=self.poisson_ratio
        )

    def idle_beside(self) -> tuple[str, tuple[str, ...]]:
        """See `ContactLaw.idle_beside`."""
        return "stiffness", ("youngs_modulus", "poisson_ratio") if self.stiffness else ()

    @property
    def needs_radii(self) -> bool:
        """True where eq. 9 supplies the stiffness."""
        return self.stiffness is None

    @property
    def least_impact_rate(self) -> float | None:
        """The floor, m/s, if it is given."""
        return self.impact_rate_floor
