"""A contact law put together of a stiffness law and a dissipation law."""

from typing import Annotated, Literal

from jointplay.solver.laws.contact.law import ContactLaw
from jointplay.solver.laws.dissipation import LAWS as DISSIPATION_LAWS
from jointplay.solver.laws.dissipation import Dissipation, Elastic
from jointplay.solver.laws.fit import Fit
from jointplay.solver.laws.stiffness import LAWS as STIFFNESS_LAWS
from jointplay.solver.laws.stiffness import Stiffness
from jointplay.solver.quantities.registry import MemberOf
from jointplay.solver.quantities.scalars import Scalar, positive_part
from jointplay.solver.quantities.units import Rule


class StiffnessAndDissipation(ContactLaw):
    """F_n of a dissipation law on top of the elastic force of a stiffness law, never pulling.

    Each is chosen by its name, `{"law": ...}`, with its own parameters.

    Assumes that the elastic part alone stores energy: what remains stored where contact is let go
    is lost. Fails where its parts do.

    Source: the pairing of Machado, Moreira, Flores and Lankarani 2012, Mech. Mach. Theory 53:99.
    """

    law: Literal["stiffness-and-dissipation"] = "stiffness-and-dissipation"
    stiffness: Annotated[Stiffness, MemberOf(STIFFNESS_LAWS, "law", required=True)]
    dissipation: Annotated[Dissipation, MemberOf(DISSIPATION_LAWS, "law", required=True)]

    def normal_force(self, fit: Fit, depth: Scalar, rate: Scalar, impact_rate: Scalar) -> Scalar:
        """Return F_n, N."""
        elastic = Elastic(self.stiffness, fit, depth)
        return positive_part(self.dissipation.normal_force(elastic, rate, impact_rate))

    def elastic_energy(self, fit: Fit, depth: Scalar) -> Scalar:
        """Return what the stiffness stores, J."""
        return self.stiffness.energy(fit, depth)

    def deepest(self, fit: Fit) -> Scalar:
        """Return how deep the stiffness is what its source says, m."""
        return self.stiffness.deepest(fit)

    @property
    def clearance_rules(self) -> tuple[Rule, ...]:
        """Rules of the stiffness."""
        return self.stiffness.fit_rules

    @property
    def needs_radii(self) -> bool:
        """True where the stiffness needs them."""
        return self.stiffness.needs_radii

    @property
    def least_impact_rate(self) -> float | None:
        """The floor of the dissipation, m/s, if it is given."""
        return self.dissipation.least_impact_rate

    @property
    def title(self) -> str:
        """The names of both parts."""
        return f"{self.stiffness.law} with {self.dissipation.law}"

    @property
    def jumps_at_onset(self) -> bool:
        """True where the dissipation acts at no depth."""
        return self.dissipation.jumps_at_onset(self.stiffness)

    @property
    def tangent_obstacle(self) -> str:
        """A force that is there at once where a contact begins."""
        if not self.jumps_at_onset:
            return ""
        return (
            f"The force of '{self.title}' jumps where a contact begins, and a tangent with it."
            " Choose a dissipation law that is a multiple of the elastic force."
        )
