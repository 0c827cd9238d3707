"""A linear spring and a viscous damper, side by side between two points."""

from typing import Annotated, ClassVar, Literal

from jointplay.solver.laws.force.distance import CHANNELS, distance
from jointplay.solver.laws.force.law import Effect, Ends, ForceElement
from jointplay.solver.quantities.units import Rule, quantity


class SpringDamper(ForceElement):
    """T = k (L - L_0) + c dL/dt, along the line between the points.

    T is the tension (N, positive: it pulls the points together), L the distance of the points (m),
    k the stiffness, L_0 the free length, c the damping.

    With k = 0 and without a damping it measures the distance, and exerts nothing.

    Assumes a massless element, whose force depends on its own length alone. Fails where the points
    meet: a free length above zero has no direction there, and the force turns over at once.

    Source: Shabana 2020, Dynamics of Multibody Systems, 5th ed., section 3.4.
    """

    type: Literal["spring-damper"]
    stiffness: Annotated[float, quantity("N/m", ge=0.0, le=1e12, structural=[0.0])] = 0.0
    damping: Annotated[float, quantity("N s/m", ge=0.0, le=1e12, structural=[0.0])] = 0.0
    free_length: Annotated[float, quantity("m", ge=0.0, le=1e3, structural=[0.0])] = 0.0
    rules: ClassVar[tuple[Rule, ...]] = (
        Rule(
            "stiffness",
            lambda element: element.model_fields_set.isdisjoint(("stiffness", "damping")),
            lambda _element: (
                "Without stiffness and damping there is no force; give one of them. A stiffness of"
                " 0 measures the distance."
            ),
        ),
    )
    channels: ClassVar[tuple[tuple[str, str, str], ...]] = CHANNELS

    def effect(self, ends: Ends) -> Effect:
        """Return tension along the line, stored energy k (L - L_0)² / 2 and loss c (dL/dt)²."""
        length, (ux, uy), rate = distance(ends)
        stretch = length - self.free_length
        tension = self.stiffness * stretch + self.damping * rate
        return Effect(
            (-(tension * ux), -(tension * uy)),
            {"force": tension, "length": length, "rate": rate},
            stored=0.5 * (self.stiffness * (stretch * stretch)),
            loss=self.damping * (rate * rate),
        )

    def strength(self, length: float) -> float:
        """Return its force where it is stretched by a length, N."""
        return self.stiffness * length

    @property
    def needs_direction(self) -> bool:
        """True with a free length and a stiffness."""
        return self.stiffness * self.free_length > 0.0
