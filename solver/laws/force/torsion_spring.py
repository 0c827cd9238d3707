"""A linear torsion spring and a viscous damper between two bodies."""

from typing import Annotated, ClassVar, Literal

from jointplay.solver.laws.force.law import Effect, Ends, ForceElement
from jointplay.solver.quantities.units import Angle, Rule, quantity


class TorsionSpring(ForceElement):
    """M = -k (φ - φ_0) - c dφ/dt, on the second point's body; its opposite acts on the first's.

    φ is the angle of the second point's body less that of the first's (rad), of which whole turns
    count, φ_0 the free angle, k the stiffness, c the damping. With k = 0 and without a damping it
    measures the angle, and exerts nothing.

    Assumes a massless element whose moment depends on its own angle alone; where the points are
    does not matter. Fails for springs wound so far that their coils touch.

    Source: Shabana 2020, Dynamics of Multibody Systems, 5th ed., section 3.4.
    """

    is_moment: ClassVar[bool] = True
    type: Literal["torsion-spring"]
    stiffness: Annotated[float, quantity("N m/rad", ge=0.0, le=1e12, structural=[0.0])] = 0.0
    damping: Annotated[float, quantity("N m s/rad", ge=0.0, le=1e12, structural=[0.0])] = 0.0
    free_angle: Angle = 0.0
    rules: ClassVar[tuple[Rule, ...]] = (
        Rule(
            "stiffness",
            lambda element: element.model_fields_set.isdisjoint(("stiffness", "damping")),
            lambda _element: (
                "Without stiffness and damping there is no moment; give one of them. A stiffness of"
                " 0 measures the angle."
            ),
        ),
    )
    channels: ClassVar[tuple[tuple[str, str, str], ...]] = (
        ("moment", "N m", "moment on the second point's body"),
        ("angle", "rad", "angle of the second body less that of the first"),
        ("rate", "rad/s", "rate of the angle"),
    )

    def effect(self, ends: Ends) -> Effect:
        """Return the moment, stored energy k (φ - φ_0)² / 2 and loss c (dφ/dt)²."""
        angle, rate = ends.angles[1] - ends.angles[0], ends.spins[1] - ends.spins[0]
        twist = angle - self.free_angle
        moment = -(self.stiffness * twist + self.damping * rate)
        return Effect(
            (0.0, 0.0),
            {"moment": moment, "angle": angle, "rate": rate},
            stored=0.5 * (self.stiffness * (twist * twist)),
            loss=self.damping * (rate * rate),
            moment=moment,
        )

    def turns_counted(self) -> tuple[str, str]:
        """Return its points."""
        return self.first, self.second

    def strength(self, length: float) -> float:
        """Return its moment at a radian, as a force at a length, N."""
        return self.stiffness / length
