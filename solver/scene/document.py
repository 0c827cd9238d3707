"""The scene: a planar mechanism as a JSON document, in SI units.

Bodies carry named points in body coordinates (origin at the centre of mass). Joints hold two
points together; a reference ``body.point`` names one, ``ground.point`` a point that never moves.
"""

from typing import Annotated, Final, Literal

from pydantic import Field

from jointplay.solver.joints import JOINTS, Gear, Joint
from jointplay.solver.joints.starts import GuideStart, JournalStart
from jointplay.solver.laws.force import ELEMENTS, ForceElement
from jointplay.solver.quantities.registry import MemberOf
from jointplay.solver.quantities.units import (
    Acceleration,
    Angle,
    AngularVelocity,
    Inertia,
    Mass,
    Name,
    Point,
    PointReference,
    Strict,
    Velocity,
    quantity,
)
from jointplay.solver.scene.drivers import AnyDriver


class Body(Strict):
    """A rigid body: mass, moment of inertia about the centre of mass, named points."""

    mass: Mass
    inertia: Inertia
    points: Annotated[dict[Name, Point], Field(max_length=96)] = {}


class Ground(Strict):
    """The frame: named points in world coordinates."""

    points: Annotated[dict[Name, Point], Field(max_length=256)] = {}


AnyJoint = Annotated[Joint, MemberOf(JOINTS, "type", required=True)]
Element = Annotated[ForceElement, MemberOf(ELEMENTS, "type", required=True)]


class Start(Strict):
    """The pose and the velocities at t = 0, as far as they are given.

    Journals start concentric unless `joints` says where; sliders, pins in slots and followers in
    the middle of their play unless `guides` does. Angles, positions of points of bodies in the
    world, and velocities hold if the joints allow it, within their play; what is not given is
    fitted. What cannot hold all together holds in its order as far as it can, the rest comes as
    near as it gets, in the nearest of the assemblies.
    """

    angles: Annotated[dict[Name, Angle], Field(max_length=96)] = {}
    points: Annotated[dict[PointReference, Point], Field(max_length=256)] = {}
    angular_velocities: Annotated[dict[Name, AngularVelocity], Field(max_length=96)] = {}
    velocities: Annotated[
        dict[Name, Annotated[list[Velocity], Field(min_length=2, max_length=2)]],
        Field(max_length=96),
    ] = {}
    joints: Annotated[dict[Name, JournalStart], Field(max_length=128)] = {}
    guides: Annotated[dict[Name, GuideStart], Field(max_length=128)] = {}


POINTER_KEY: Final = r"(0|[1-9][0-9]{0,8}|[A-Za-z_.-][A-Za-z0-9_.-]{0,64})"
"""A field, a name, or an index, which is written in one way."""


class Target(Strict):
    """Where a parameter goes to: a JSON pointer into this document, and a factor."""

    path: Annotated[str, Field(pattern=rf"^(/{POINTER_KEY}){{1,8}}$")]
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
    choices: Annotated[list[str], Field(min_length=1, max_length=16)] | None = None
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
    duration: Annotated[float, quantity("s", gt=0.0)]
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
    period: Annotated[
        float | None,
        quantity(
            "s",
            gt=0.0,
            le=1e6,
            description="time between sections where what drives the scene does not repeat",
        ),
    ] = None
    length: Annotated[
        float | None,
        quantity(
            "m",
            gt=0.0,
            le=1e6,
            description=(
                "what counts as one length where motions are compared, and starts perturbed;"
                " default: the smallest clearance, else the shortest link, else 1 m"
            ),
        ),
    ] = None
    ground: Ground = Ground()
    bodies: Annotated[dict[Name, Body], Field(min_length=1, max_length=96)]
    joints: Annotated[dict[Name, AnyJoint], Field(min_length=1, max_length=128)]
    gears: Annotated[dict[Name, Gear], Field(max_length=64)] = {}
    drivers: Annotated[dict[Name, AnyDriver], Field(max_length=64)] = {}
    forces: Annotated[dict[Name, Element], Field(max_length=64)] = {}
    start: Start = Start()
    parameters: Annotated[dict[Name, Parameter], Field(max_length=64)] = {}
    recorded: Annotated[list[PointReference], Field(max_length=64)] = []
    outputs: Annotated[list[Output], Field(max_length=64)] = []
    reported: Annotated[list[Reported], Field(max_length=256)] = []
