"""Joints of a scene, which hold two points together, with play or without; gears between them."""

from typing import Annotated, Literal

from pydantic import Field

from jointplay.solver.laws.contact import LAWS as CONTACT_LAWS
from jointplay.solver.laws.contact import ContactLaw
from jointplay.solver.laws.friction import LAWS as FRICTION_LAWS
from jointplay.solver.laws.friction import FrictionLaw
from jointplay.solver.quantities.roster import MemberOf
from jointplay.solver.quantities.units import (
    Angle,
    Direction,
    Name,
    PointReference,
    RadialClearance,
    Radius,
    Strict,
    quantity,
)
from jointplay.solver.scene.cams import FlatFollower, RollerFollower


class Clearance(Strict):
    """Play of a revolute joint: the journal moves inside the bearing and touches its wall.

    The journal's radius is the bearing's less the radial clearance. A radial clearance of zero is
    an ideal joint. Contact laws of lines need the bearing's width, its length along the axis.
    """

    radial_clearance: RadialClearance
    bearing_radius: Radius
    bearing_width: Radius | None = None
    contact: Annotated[ContactLaw, MemberOf(CONTACT_LAWS, "law")]
    friction: Annotated[FrictionLaw, MemberOf(FRICTION_LAWS, "law")] | None = None


class SliderClearance(Strict):
    """Play of a slider in its guide, whose walls its four corners may touch.

    The slider is a rectangle about its point, `length` long along the axis and `height` high across
    it; the guide's walls are straight, without end, and `wall_clearance` away from the centred
    slider on both sides. A wall clearance of zero is an ideal joint.
    """

    wall_clearance: RadialClearance
    length: Radius
    height: Radius
    contact: Annotated[ContactLaw, MemberOf(CONTACT_LAWS, "law")]
    friction: Annotated[FrictionLaw, MemberOf(FRICTION_LAWS, "law")] | None = None


class PinClearance(Strict):
    """Play of a pin in a slot, whose two straight walls, without end, it may touch.

    Both are `wall_clearance` away from the centred pin. A wall clearance of zero is an ideal joint.
    """

    wall_clearance: RadialClearance
    pin_radius: Radius
    contact: Annotated[ContactLaw, MemberOf(CONTACT_LAWS, "law")]
    friction: Annotated[FrictionLaw, MemberOf(FRICTION_LAWS, "law")] | None = None


class Revolute(Strict):
    """A pin joint between a point of the bearing body and a point of the journal body."""

    type: Literal["revolute"]
    bearing: PointReference
    journal: PointReference
    clearance: Clearance | None = None


class Prismatic(Strict):
    """A slider: its point moves along the axis through the guide's point, without turning.

    `axis` is a direction in the guide body's coordinates; `angle` is the slider body's angle less
    the guide body's. With a clearance both are those of the slider centred in its guide.
    """

    type: Literal["prismatic"]
    guide: PointReference
    slider: PointReference
    axis: Direction
    angle: Angle = 0.0
    clearance: SliderClearance | None = None


class PinInSlot(Strict):
    """A pin in a straight slot: its point stays on the axis through the slot's point, and may turn.

    `axis` is a direction in the slot body's coordinates.
    """

    type: Literal["pin-in-slot"]
    slot: PointReference
    pin: PointReference
    axis: Direction
    clearance: PinClearance | None = None


class Fixed(Strict):
    """Two bodies welded at a point; `angle` is the part's angle less the base's."""

    type: Literal["fixed"]
    base: PointReference
    part: PointReference
    angle: Angle = 0.0


class Gear(Strict):
    """Gears or a belt: the second joint's angle is `ratio` times the first's, plus `offset`.

    Both joints are revolute; a driver may turn one, if something else is left to move. An angle is
    the journal body's less the bearing body's. An external pair of wheels with radii R_1 and R_2
    has the ratio -R_1 / R_2, a belt or an internal one R_1 / R_2.
    """

    first: Name
    second: Name
    ratio: Annotated[float, quantity("1", ge=-1e4, le=1e4)]
    offset: Angle = 0.0


Joint = Annotated[
    Revolute | Prismatic | PinInSlot | FlatFollower | RollerFollower | Fixed,
    Field(discriminator="type"),
]
