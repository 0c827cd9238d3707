"""Hunt and Crossley's damping with a given coefficient, without memory."""

from typing import Annotated, Literal

from jointplay.solver.laws.dissipation.law import Dissipation, Elastic
from jointplay.solver.quantities.scalars import Scalar
from jointplay.solver.quantities.units import quantity


class HuntCrossleyUnlatched(Dissipation):
    """F_n = F_e (1 + 3/2 α δ̇).

    F_e is the elastic force (N), δ̇ the rate (m/s), α the loss of restitution with speed: slow
    impacts return 1 - α δ̇⁻ of their speed δ̇⁻.

    Assumes that restitution falls with speed, as that of metals does. Fails for α δ̇⁻ beyond 0.3,
    where less is lost than that. Good in lasting contact: there is no latched rate.

    Source: Hunt and Crossley 1975, J. Appl. Mech. 42:440; as
    the point contact of Drake.
    """

    law: Literal["hunt-crossley-unlatched"] = "hunt-crossley-unlatched"
    loss: Annotated[float, quantity("s/m", ge=0.0, le=1e6, description="α")]

    def normal_force(self, elastic: Elastic, rate: Scalar, impact_rate: Scalar) -> Scalar:
        """Return F_n, N."""
        return elastic.force * (1.0 + 1.5 * self.loss * rate)
