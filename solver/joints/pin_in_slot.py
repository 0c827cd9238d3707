"""A pin in a straight slot, with play or without."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Annotated, ClassVar, Literal

import numpy as np

from jointplay.records.arrays import Flags
from jointplay.solver.joints.contact import Contact, ContactState
from jointplay.solver.joints.drawing import Drawing
from jointplay.solver.joints.holding import Holding, Row
from jointplay.solver.joints.joint import AnyClearance, Joint
from jointplay.solver.joints.starts import GuideStart
from jointplay.solver.joints.wall import WALL, Wall, at_wall, wall_normal
from jointplay.solver.laws.contact import LAWS as CONTACT_LAWS
from jointplay.solver.laws.contact import ContactLaw
from jointplay.solver.laws.force import Ends
from jointplay.solver.laws.friction import LAWS as FRICTION_LAWS
from jointplay.solver.laws.friction import FrictionLaw
from jointplay.solver.laws.function import Derivatives
from jointplay.solver.quantities.frames import scaled
from jointplay.solver.quantities.registry import MemberOf
from jointplay.solver.quantities.scalars import Scalar
from jointplay.solver.quantities.units import (
    Direction,
    PointReference,
    RadialClearance,
    Radius,
    Rule,
    no_length,
)

WALLS = {"wall_1": 1.0, "wall_2": -1.0}
"""Side of a slot's axis on which each wall is."""


class PinClearance(AnyClearance):
    """Play of a pin in a slot, whose two straight walls, without end, it may touch.

    Both are `wall_clearance` away from the centred pin. A wall clearance of zero is an ideal joint.
    """

    play_field: ClassVar[str] = "wall_clearance"
    wall_clearance: RadialClearance
    pin_radius: Radius
    contact: Annotated[ContactLaw, MemberOf(CONTACT_LAWS, "law")]
    friction: Annotated[FrictionLaw, MemberOf(FRICTION_LAWS, "law")] | None = None

    @property
    def rules(self) -> tuple[Rule, ...]:
        """Rules that its numbers must keep."""
        return WALL


class PinInSlot(Joint):
    """A pin in a straight slot: its point stays on the axis through the slot's point, and may turn.

    `axis` is a direction in the slot body's coordinates.
    """

    called: ClassVar[str] = "a pin in a slot"
    end_fields: ClassVar[tuple[str, str]] = ("slot", "pin")
    drawing: ClassVar[Drawing] = Drawing(
        axis="axis",
        size="pin_radius",
        positions=tuple((0.0, side) for side in WALLS.values()),
        picture="walls",
        caption="Pin of joint {} in its slot",
    )
    parts: ClassVar[tuple[str, ...]] = (*WALLS,)
    rules: ClassVar[tuple[Rule, ...]] = (no_length("axis"),)
    type: Literal["pin-in-slot"]
    slot: PointReference
    pin: PointReference
    axis: Direction
    clearance: PinClearance | None = None

    def rows(self, held: Holding[Row], _motion: Derivatives | None) -> Iterator[Row]:
        """Yield: the pin stays on the axis."""
        yield held.across(self.axis)

    @property
    def heading(self) -> Sequence[Scalar]:
        """Direction of the axis, in the slot's."""
        return self.axis

    def contact(self, name: str, part: str, between: Ends, state: ContactState) -> Contact:
        """Evaluate the contact at a wall."""
        clearance = self.clearance
        assert clearance is not None  # noqa: S101  (narrows the type)
        normal, reach = wall_normal(self.axis, WALLS[part], between), clearance.pin_radius
        wall = Wall(normal, scaled(normal, reach), reach)
        return at_wall(name, self.points, between, wall, clearance, state)

    @property
    def size(self) -> float:
        """Radius of the pin, m."""
        return 0.0 if self.clearance is None else self.clearance.pin_radius

    @property
    def loosened(self) -> Mapping[str, float]:
        """Largest violation of its constraint within its play, m."""
        return {} if self.clearance is None else {"normal": self.clearance.wall_clearance}

    def starts_in_wall(self, start: GuideStart) -> Flags | bool:
        """Return whether the pin's centre is in a wall; see `Joint.starts_in_wall`."""
        play = self.clearance
        if play is None:
            return False
        found: Flags = np.abs(start.offset) >= play.wall_clearance + play.pin_radius
        return found
