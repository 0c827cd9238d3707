"""A joint from outside: a pin in a slot that is a ring: it stays at a distance from a point."""

from collections.abc import Iterator, Mapping
from typing import Annotated, ClassVar, Literal

from jointplay.solver.joints.contact import Contact, ContactGeometry, ContactState, surfaces
from jointplay.solver.joints.drawing import Curve, Drawing, circle
from jointplay.solver.joints.holding import Distance, Holding, Row
from jointplay.solver.joints.joint import AnyClearance, Joint
from jointplay.solver.joints.wall import WALL
from jointplay.solver.laws.contact import LAWS as CONTACT_LAWS
from jointplay.solver.laws.contact import ContactLaw
from jointplay.solver.laws.force import Ends
from jointplay.solver.laws.friction import LAWS as FRICTION_LAWS
from jointplay.solver.laws.friction import FrictionLaw
from jointplay.solver.laws.function import Derivatives
from jointplay.solver.quantities.frames import dot, left, scaled
from jointplay.solver.quantities.registry import MemberOf
from jointplay.solver.quantities.scalars import Scalar, sqrt
from jointplay.solver.quantities.units import PointReference, RadialClearance, Radius, Rule

SIDES = {"outer": 1.0, "inner": -1.0}


class RingClearance(AnyClearance):
    """Play of a pin in a ring: both walls are `gap` away from the centred pin."""

    play_field: ClassVar[str] = "gap"
    gap: RadialClearance
    pin_radius: Radius
    contact: Annotated[ContactLaw, MemberOf(CONTACT_LAWS, "law")]
    friction: Annotated[FrictionLaw, MemberOf(FRICTION_LAWS, "law")] | None = None

    @property
    def rules(self) -> tuple[Rule, ...]:
        return WALL


class RingSlot(Joint):
    """A pin on a ring of some radius about the hub's point."""

    called: ClassVar[str] = "a pin in a ring"
    end_fields: ClassVar[tuple[str, str]] = ("hub", "pin")
    drawing: ClassVar[Drawing] = Drawing(
        size="pin_radius", positions=tuple((0.0, s) for s in SIDES.values())
    )
    parts: ClassVar[tuple[str, ...]] = (*SIDES,)
    type: Literal["ring-slot"]
    hub: PointReference
    pin: PointReference
    radius: Radius
    clearance: RingClearance | None = None

    def rows(self, held: Holding[Row], _motion: Derivatives | None) -> Iterator[Row]:
        yield held.apart(self._distance(held.ends))

    def contact(self, name: str, part: str, between: Ends, state: ContactState) -> Contact:
        clearance, side = self.clearance, SIDES[part]
        assert clearance is not None
        found = self._distance(between)
        n = scaled(found.along, side)
        arm = scaled(n, clearance.pin_radius)
        geometry = ContactGeometry(n, scaled(n, -1.0), arm, side * found.value)
        return surfaces(name, self.points, between, geometry, clearance, state)

    def curves(self) -> Iterator[Curve]:
        yield Curve(0, circle(self.radius))

    @property
    def size(self) -> float:
        return self.radius

    @property
    def loosened(self) -> Mapping[str, float]:
        return {"normal": self.clearance.gap} if self.clearance else {}

    def problems(self) -> Iterator[tuple[str, str]]:
        if self.clearance and self.clearance.pin_radius >= self.radius:
            yield "clearance/pin_radius", f"A pin in a ring of radius {self.radius:g} m is smaller."

    def _distance(self, between: Ends) -> Distance:
        (x, y), velocity = between.gap, between.rate
        length: Scalar = sqrt(x * x + y * y)
        e = x / length, y / length
        around = dot(left(e), velocity)
        bias = around * around / length
        return Distance(length - self.radius, e, 0.0, 0.0, dot(e, velocity), bias)
