"""The scene: a planar mechanism as a JSON document, in SI units.

Bodies carry named points in body coordinates (origin at the centre of mass). Joints hold two
points together; a reference ``body.point`` names one, ``ground.point`` a point that never moves.
"""

from abc import abstractmethod
from typing import Annotated, Any, Literal

from pydantic import Field

from jointplay.solver.laws.contact import LAWS as CONTACT_LAWS
from jointplay.solver.laws.contact import ContactLaw
from jointplay.solver.laws.force import ELEMENTS, ForceElement
from jointplay.solver.laws.friction import LAWS as FRICTION_LAWS
from jointplay.solver.laws.friction import FrictionLaw
from jointplay.solver.laws.function import FUNCTIONS, Derivatives, Function
from jointplay.solver.quantities.roster import MemberOf
from jointplay.solver.quantities.scalars import Scalar
from jointplay.solver.quantities.units import (
    Acceleration,
    Angle,
    AngularVelocity,
    Direction,
    Inertia,
    Length,
    Mass,
    Name,
    Point,
    PointReference,
    RadialClearance,
    Radius,
    Strict,
    Velocity,
)
from jointplay.solver.scene.unions import form, has, told_by


class Body(Strict):
    """A rigid body: mass, moment of inertia about the centre of mass, named points."""

    mass: Mass
    inertia: Inertia
    points: Annotated[dict[Name, Point], Field(max_length=64)] = {}


class Ground(Strict):
    """The frame: named points in world coordinates."""

    points: Annotated[dict[Name, Point], Field(max_length=256)] = {}


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

    Both joints are revolute, not driven; an angle is the journal body's less the bearing body's. An
    external pair of wheels with radii R_1 and R_2 has the ratio -R_1 / R_2, a belt or an internal
    one R_1 / R_2.
    """

    first: Name
    second: Name
    ratio: Annotated[float, Field(ge=-1e4, le=1e4, json_schema_extra={"unit": "1"})]
    offset: Angle = 0.0


Joint = Annotated[Revolute | Prismatic | PinInSlot | Fixed, Field(discriminator="type")]


Element = Annotated[ForceElement, MemberOf(ELEMENTS, "type", required=True)]


class Driver(Strict):
    """Prescribed motion of an ideal joint, or of a body's angle whatever its joints.

    For a revolute joint the position is the journal body's angle less the bearing body's (rad,
    rad/s), for a prismatic joint the slider's displacement along the axis (m, m/s), for a
    body its angle against the ground, from where the torque acts.

    Its clock is what its motion is a function of: it starts at `clock_start` and goes at
    `clock_rate` a second.
    """

    joint: Name | None = None
    body: Name | None = None
    position: Annotated[float, Field(ge=-1e4, le=1e4, json_schema_extra={"unit": "rad or m"})] = 0.0

    @abstractmethod
    def at(self, clock: Scalar) -> Derivatives:
        """Return position, speed and acceleration, in rad or m and seconds."""

    @property
    @abstractmethod
    def clock_start(self) -> Scalar:
        """What the clock shows at the start."""

    @property
    @abstractmethod
    def clock_rate(self) -> Scalar:
        """What the clock gains a second."""


class SteadyDriver(Driver):
    """Prescribed motion at constant speed, position + speed * t; its clock shows the position."""

    speed: Annotated[float, Field(ge=-1e5, le=1e5, json_schema_extra={"unit": "rad/s or m/s"})]

    def at(self, clock: Scalar) -> Derivatives:
        """See `Driver.at`."""
        return Derivatives(clock, self.speed, 0.0)

    @property
    def clock_start(self) -> Scalar:
        """See `Driver.clock_start`."""
        return self.position

    @property
    def clock_rate(self) -> Scalar:
        """See `Driver.clock_rate`."""
        return self.speed


class MovingDriver(Driver):
    """Prescribed motion that is a function of time: position + motion(t); its clock shows t."""

    motion: Annotated[Function, MemberOf(FUNCTIONS, "type", required=True)]

    def at(self, clock: Scalar) -> Derivatives:
        """See `Driver.at`."""
        moved = self.motion.at(clock)
        return moved._replace(value=self.position + moved.value)

    @property
    def clock_start(self) -> Scalar:
        """See `Driver.clock_start`."""
        return 0.0

    @property
    def clock_rate(self) -> Scalar:
        """See `Driver.clock_rate`."""
        return 1.0


def _form_of_driver(value: Any) -> str:
    return "motion" if has(value, "motion") else "speed"


AnyDriver = Annotated[
    Annotated[SteadyDriver, form("speed")] | Annotated[MovingDriver, form("motion")],
    told_by(_form_of_driver, "a driver is an object with 'speed' or with 'motion'"),
]


class JournalStart(Strict):
    """Where a journal starts in its bearing, in world axes: its centre less the bearing's.

    Without a rate it moves as the velocities of the bodies say, else not. A journal that starts in
    contact has its rate of penetration as impact rate, or the floor of that if it is larger.
    """

    eccentricity: Annotated[list[Length], Field(min_length=2, max_length=2)] = [0.0, 0.0]
    rate: Annotated[list[Velocity], Field(min_length=2, max_length=2)] | None = None


class Start(Strict):
    """Where Newton's iteration on the geometry begins, and what the constraints leave free.

    Journals start concentric unless `joints` says where; positions and velocities are those of the
    mechanism that holds them there, but for a body whose velocity is given: its journal may move in
    its bearing from the start, and its slider move and turn in its guide. Angles choose between the
    assemblies that a mechanism allows.
    """

    angles: Annotated[dict[Name, Angle], Field(max_length=64)] = {}
    angular_velocities: Annotated[dict[Name, AngularVelocity], Field(max_length=64)] = {}
    velocities: Annotated[
        dict[Name, Annotated[list[Velocity], Field(min_length=2, max_length=2)]],
        Field(max_length=64),
    ] = {}
    joints: Annotated[dict[Name, JournalStart], Field(max_length=128)] = {}


class Target(Strict):
    """Where a parameter goes: a JSON pointer into this document, times a factor."""

    path: Annotated[str, Field(pattern=r"^(/[A-Za-z0-9_-]{1,40}){1,8}$")]
    factor: float = 1.0


class Parameter(Strict):
    """A declared knob of a scene; a default of none leaves the document's own values alone.

    One that is required and has no default must be given: what the document says there is a place
    for it only, because the source does not say.
    """

    help: Annotated[str, Field(max_length=300)]
    unit: Annotated[str, Field(max_length=20)] = "1"
    default: float | str | None = None
    required: Annotated[bool, Field(description="without a default, it must be given")] = False
    minimum: float | None = None
    maximum: float | None = None
    choices: Annotated[list[str], Field(max_length=16)] | None = None
    inferred: Annotated[
        bool, Field(description="the source does not print this default; it was inferred")
    ] = False
    targets: Annotated[list[Target], Field(min_length=1, max_length=64)]


class Output(Strict):
    """A declared output: factor * channel + offset, under a name of its own."""

    name: Name
    channel: Annotated[str, Field(max_length=64)]
    factor: float = 1.0
    offset: float = 0.0
    help: Annotated[str, Field(max_length=300)] = ""


class Reported(Strict):
    """A number that the scene's source printed, to be set beside ours."""

    where: Annotated[str, Field(max_length=120)]
    parameters: Annotated[dict[Name, float | str], Field(max_length=32)] = {}
    duration: Annotated[float, Field(gt=0.0, json_schema_extra={"unit": "s"})]
    channel: Annotated[str, Field(max_length=64)]
    statistic: Literal["maximum", "minimum"]
    value: float
    unit: Annotated[str, Field(max_length=20)]
    note: Annotated[str, Field(max_length=300)] = ""


class Scene(Strict):
    """A planar mechanism, its drivers, forces and gravity, its knobs and its outputs.

    `recorded` are points of bodies whose motion becomes channels; those of a job's channels do so
    by being named there.
    """

    name: Name
    description: Annotated[str, Field(max_length=2000)] = ""
    source: Annotated[str, Field(max_length=500)] = ""
    gravity: Annotated[list[Acceleration], Field(min_length=2, max_length=2)] = [0.0, 0.0]
    ground: Ground = Ground()
    bodies: Annotated[dict[Name, Body], Field(min_length=1, max_length=64)]
    joints: Annotated[dict[Name, Joint], Field(min_length=1, max_length=128)]
    gears: Annotated[dict[Name, Gear], Field(max_length=64)] = {}
    drivers: Annotated[dict[Name, AnyDriver], Field(max_length=64)] = {}
    forces: Annotated[dict[Name, Element], Field(max_length=64)] = {}
    start: Start = Start()
    parameters: Annotated[dict[Name, Parameter], Field(max_length=64)] = {}
    recorded: Annotated[list[PointReference], Field(max_length=64)] = []
    outputs: Annotated[list[Output], Field(max_length=64)] = []
    reported: Annotated[list[Reported], Field(max_length=256)] = []
