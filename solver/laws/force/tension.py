"""A force along the line between two points, constant or varying."""

from typing import Annotated, ClassVar, Literal

import numpy as np

from jointplay.solver.laws.force.distance import CHANNELS, distance
from jointplay.solver.laws.force.law import Effect, Ends
from jointplay.solver.laws.force.varying import Varying
from jointplay.solver.quantities.units import quantity


class Tension(Varying):
    """T = magnitude * course(...), along the line between the points.

    T is the tension (N, positive: it pulls the points together). Over `distance` it is a spring of
    any characteristic, a magnet, a gas spring; over the rate of the distance a damper of any.

    Assumes a massless element. Fails where the points meet: the force has no direction there, and
    one that is not zero turns over at once. All its work counts as loss, none as stored.

    Source: the definition of work, dW = -T dL; Goldstein 1980, Classical Mechanics, 1.1.
    """

    type: Literal["tension"]
    magnitude: Annotated[float, quantity("N", ge=-1e12, le=1e12)]
    channels: ClassVar[tuple[tuple[str, str, str], ...]] = CHANNELS

    def effect(self, ends: Ends) -> Effect:
        """Return the tension along the line; what it puts in is a loss below zero."""
        length, (ux, uy), rate = distance(ends)
        tension = self.varied(self.magnitude, ends)
        return Effect(
            (-(tension * ux), -(tension * uy)),
            {"force": tension, "length": length, "rate": rate},
            loss=tension * rate,
        )

    def strength(self, length: float) -> float:
        """Return its magnitude, N."""
        return abs(self.magnitude)

    @property
    def needs_direction(self) -> bool:
        """True, for the line between the points is its direction; but if it is 0 at no distance."""
        over = self.follows()
        if self.course is None or over is None or over.quantity != "distance" or over.rate:
            return True
        own = (over.first or self.first, over.second or self.second)
        return own != (self.first, self.second) or bool(np.any(self.course.at(0.0).value))
