"""Shared parts of stiffness laws of one material: its constants, and a bearing's width."""

from typing import Annotated, ClassVar

from jointplay.solver.laws.stiffness.law import Stiffness
from jointplay.solver.quantities.scalars import Scalar
from jointplay.solver.quantities.units import Rule, quantity

YoungsModulus = Annotated[float, quantity("Pa", gt=0.0, le=1e15)]
PoissonRatio = Annotated[float, quantity("1", ge=0.0, lt=0.5)]


class OfMaterial(Stiffness):
    """A stiffness of journal and bearing of one material."""

    youngs_modulus: YoungsModulus = 2.07e11
    poisson_ratio: PoissonRatio = 0.29

    @property
    def compliance(self) -> Scalar:
        """(1 - ν²) / E of one part, 1/Pa."""
        return (1.0 - self.poisson_ratio * self.poisson_ratio) / self.youngs_modulus

    @property
    def effective_modulus(self) -> Scalar:
        """E* of both parts, Pa: 1 / E* is the sum of their compliances."""
        return 1.0 / (self.compliance + self.compliance)


class OfWidth(OfMaterial):
    """A stiffness of a line contact, which grows with the bearing's width."""

    fit_rules: ClassVar[tuple[Rule, ...]] = (
        Rule(
            "bearing_width",
            lambda clearance: clearance.bearing_width is None,
            lambda clearance: (
                f"The stiffness law '{clearance.contact.stiffness.law}' needs the bearing's width;"
                " give a bearing_width in m."
            ),
        ),
    )
