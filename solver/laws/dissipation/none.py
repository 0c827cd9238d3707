"""No damping: an elastic contact."""

from typing import Literal

from jointplay.solver.laws.dissipation.law import Dissipation, Elastic
from jointplay.solver.quantities.scalars import Scalar


class NoDissipation(Dissipation):
    """F_n = F_e.

    Assumes elastic bodies. Fails where impacts lose energy: bouncing never ends.

    Source: Hertz 1882, as printed in Johnson 1985, Contact Mechanics, eq. 4.22.
    """

    law: Literal["none"] = "none"

    def normal_force(self, elastic: Elastic, rate: Scalar, impact_rate: Scalar) -> Scalar:
        """Return F_e, N."""
        return elastic.force
