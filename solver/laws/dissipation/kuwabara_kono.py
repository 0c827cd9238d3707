"""Kuwabara and Kono's damping: that of viscoelastic spheres."""

from typing import Annotated, Literal

from jointplay.solver.laws.dissipation.law import Dissipation, Elastic
from jointplay.solver.laws.stiffness import Stiffness
from jointplay.solver.quantities.scalars import Scalar
from jointplay.solver.quantities.units import quantity


class KuwabaraKono(Dissipation):
    """F_n = F_e + A dF_e/dδ δ̇, never pulling.

    F_e is the elastic force (N), δ the depth (m), δ̇ its rate (m/s), A a time of relaxation. With
    F_e = K δ^1.5 it is K δ^1.5 + 1.5 A K δ^0.5 δ̇.

    Assumes a material that relaxes faster than the impact lasts. Fails for strong damping, where
    A is no longer short. Good in lasting contact: there is no latched rate.

    Source: Kuwabara and Kono 1987, Jpn. J. Appl. Phys. 26:1230; Brilliantov, Spahn, Hertzsch and
    Poeschel 1996, Phys. Rev. E 53:5382.
    """

    law: Literal["kuwabara-kono"] = "kuwabara-kono"
    relaxation_time: Annotated[float, quantity("s", ge=0.0, le=1.0, description="A")]

    def normal_force(self, elastic: Elastic, rate: Scalar, impact_rate: Scalar) -> Scalar:
        """Return F_n, N."""
        return elastic.force + self.relaxation_time * elastic.slope * rate

    def jumps_at_onset(self, stiffness: Stiffness) -> bool:
        """Tell whether it does: where the stiffness is there at once."""
        return self.relaxation_time > 0.0 and stiffness.is_stiff_at_once
