"""A force of given direction at a point."""

from typing import Annotated, ClassVar, Literal

from jointplay.solver.laws.force.law import Effect, Ends
from jointplay.solver.laws.force.varying import Varying
from jointplay.solver.quantities.scalars import sqrt
from jointplay.solver.quantities.units import Direction, Rule, no_length, quantity


class Force(Varying):
    """F = magnitude * course(...) along a direction, on the second point.

    Its opposite acts on the first point's body along the same line. The direction is fixed in the
    world's axes, or in those of either body.

    Assumes that it keeps its direction whatever the body does. Fails where a tool touches what it
    presses: there the force has play and friction of its own.

    Source: the definition of work, dW = F · dr; Goldstein 1980, Classical Mechanics, 1.1.
    """

    type: Literal["force"]
    magnitude: Annotated[float, quantity("N", ge=-1e12, le=1e12)]
    direction: Direction
    axes: Literal["world", "first", "second"] = "world"
    rules: ClassVar[tuple[Rule, ...]] = (no_length("direction"),)
    channels: ClassVar[tuple[tuple[str, str, str], ...]] = (
        ("force", "N", "force along its direction on the second point"),
    )

    def effect(self, ends: Ends) -> Effect:
        """Return the force; what it puts in is a loss below zero."""
        x, y = self.direction
        cosine, sine = {"world": (1.0, 0.0), "first": ends.turned[0]}.get(self.axes, ends.turned[1])
        force = self.varied(self.magnitude, ends)
        along = force / sqrt(x * x + y * y)
        fx, fy = along * (cosine * x - sine * y), along * (sine * x + cosine * y)
        (gx, gy), (vx, vy) = ends.gap, ends.rate
        couple = gy * fx - gx * fy
        power = fx * vx + fy * vy + couple * ends.spins[0]
        return Effect((fx, fy), {"force": force}, loss=-power, couple=couple)

    def strength(self, length: float) -> float:
        """Return its magnitude, N."""
        return abs(self.magnitude)
