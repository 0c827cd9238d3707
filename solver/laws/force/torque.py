"""A torque between two bodies, constant or varying."""

from typing import Annotated, ClassVar, Literal

from jointplay.solver.laws.force.law import Effect, Ends
from jointplay.solver.laws.force.varying import Varying
from jointplay.solver.quantities.units import quantity


class Torque(Varying):
    """M = moment * course(...), on the second point's body; its opposite acts on the first's.

    Assumes that it keeps its value at any speed, unless it varies with that; where the points are
    does not matter. Fails for motors and brakes near the speeds where their characteristics bend:
    nothing holds the speed that it gives.

    Source: the definition of a couple's work, dW = M dθ; Goldstein 1980, Classical Mechanics, 1.1.
    """

    is_moment: ClassVar[bool] = True
    type: Literal["torque"]
    moment: Annotated[float, quantity("N m", ge=-1e12, le=1e12)]
    channels: ClassVar[tuple[tuple[str, str, str], ...]] = (
        ("moment", "N m", "moment on the second point's body"),
    )

    def effect(self, ends: Ends) -> Effect:
        """Return the moment; what it puts in is a loss below zero."""
        moment = self.varied(self.moment, ends)
        power = moment * (ends.spins[1] - ends.spins[0])
        return Effect((0.0, 0.0), {"moment": moment}, loss=-power, moment=moment)

    def strength(self, length: float) -> float:
        """Return its moment as a force at a length, N."""
        return abs(self.moment) / length
