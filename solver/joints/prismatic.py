"""A slider in its guide, with play or without."""

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Annotated, ClassVar, Literal

import numpy as np

from jointplay.records.arrays import Flags
from jointplay.solver.joints.contact import Contact, ContactState
from jointplay.solver.joints.drawing import Drawing
from jointplay.solver.joints.holding import Holding, Row
from jointplay.solver.joints.joint import AnyClearance, Freedom, Joint
from jointplay.solver.joints.starts import GuideStart
from jointplay.solver.joints.wall import WALL, Wall, at_wall, wall_normal
from jointplay.solver.laws.contact import LAWS as CONTACT_LAWS
from jointplay.solver.laws.contact import ContactLaw
from jointplay.solver.laws.force import Ends
from jointplay.solver.laws.friction import LAWS as FRICTION_LAWS
from jointplay.solver.laws.friction import FrictionLaw
from jointplay.solver.laws.function import Derivatives
from jointplay.solver.quantities.frames import Pair, left, plus, scaled, turned, unit
from jointplay.solver.quantities.registry import MemberOf
from jointplay.solver.quantities.scalars import Scalar, sine_cosine
from jointplay.solver.quantities.units import (
    Angle,
    Direction,
    PointReference,
    RadialClearance,
    Radius,
    Rule,
    no_length,
)

CORNERS = {"corner_1": (1.0, 1.0), "corner_2": (-1.0, 1.0)}
CORNERS |= {"corner_3": (-1.0, -1.0), "corner_4": (1.0, -1.0)}
"""Positions of a slider's corners along its axis and across it, in halves of length and height."""
SLIDER = (
    *WALL,
    Rule(
        "length",
        lambda clearance: (
            np.hypot(clearance.length, clearance.height)
            <= clearance.height + 2.0 * clearance.wall_clearance
        ),
        lambda clearance: (
            f"A slider {clearance.length:g} m long and {clearance.height:g} m high could turn over"
            f" between walls {clearance.height + 2.0 * clearance.wall_clearance:g} m apart; make it"
            " longer."
        ),
    ),
)


class SliderClearance(AnyClearance):
    """Play of a slider in its guide, whose walls its four corners may touch.

    The slider is a rectangle about its point, `length` long along the axis and `height` high across
    it; the guide's walls are straight, without end, and `wall_clearance` away from the centred
    slider on both sides. A wall clearance of zero is an ideal joint.
    """

    play_field: ClassVar[str] = "wall_clearance"
    wall_clearance: RadialClearance
    length: Radius
    height: Radius
    contact: Annotated[ContactLaw, MemberOf(CONTACT_LAWS, "law")]
    friction: Annotated[FrictionLaw, MemberOf(FRICTION_LAWS, "law")] | None = None

    @property
    def rules(self) -> tuple[Rule, ...]:
        """Rules that its numbers must keep."""
        return SLIDER


class Prismatic(Joint):
    """A slider: its point moves along the axis through the guide's point, without turning.

    `axis` is a direction in the guide body's coordinates; `angle` is the slider body's angle less
    the guide body's. With a clearance both are those of the slider centred in its guide.
    """

    called: ClassVar[str] = "a slider"
    end_fields: ClassVar[tuple[str, str]] = ("guide", "slider")
    drawing: ClassVar[Drawing] = Drawing(
        sign="",
        axis="axis",
        size="height",
        block=("length", "height"),
        positions=(*CORNERS.values(),),
        picture="walls",
        caption="Slider of joint {} in its guide",
    )
    freedom: ClassVar[Freedom] = "slide"
    holds_angle: ClassVar[bool] = True
    parts: ClassVar[tuple[str, ...]] = (*CORNERS,)
    rules: ClassVar[tuple[Rule, ...]] = (no_length("axis"),)
    type: Literal["prismatic"]
    guide: PointReference
    slider: PointReference
    axis: Direction
    angle: Angle = 0.0
    clearance: SliderClearance | None = None

    def rows(self, held: Holding[Row], motion: Derivatives | None) -> Iterator[Row]:
        """Yield: the slider stays on the axis, at its angle, and moves as driven."""
        yield held.across(self.axis)
        yield held.at_angle(self.angle)
        if motion is not None:
            yield held.along(self.axis, motion)

    @property
    def heading(self) -> Sequence[Scalar]:
        """Direction of the axis, in the guide's."""
        return self.axis

    def contact(self, name: str, part: str, between: Ends, state: ContactState) -> Contact:
        """Evaluate the contact of a corner."""
        clearance = self.clearance
        assert clearance is not None  # noqa: S101  (narrows the type)
        wall = Wall(
            wall_normal(self.axis, CORNERS[part][1], between),
            self._corner(clearance, part, between.turned[1]),
            0.5 * clearance.height,
        )
        return at_wall(name, self.points, between, wall, clearance, state)

    @property
    def size(self) -> float:
        """Half the slider's diagonal, m."""
        if self.clearance is None:
            return 0.0
        return 0.5 * math.hypot(self.clearance.length, self.clearance.height)

    @property
    def loosened(self) -> Mapping[str, float]:
        """Largest violation of each part of its constraint within its play, m and rad."""
        if self.clearance is None:
            return {}
        play = self.clearance.wall_clearance
        return {"normal": play, "angle": 2.0 * play / self.clearance.length}

    def is_within(self, parts: Mapping[str, float], play: float) -> bool:
        """Return whether no corner is beyond a wall."""
        assert self.clearance is not None  # noqa: S101  (narrows the type)
        turned = 0.5 * self.clearance.length * abs(sine_cosine(parts["angle"])[0])
        return bool(abs(parts["normal"]) + turned <= play)

    def starts_in_wall(self, start: GuideStart) -> Flags | bool:
        """Return whether a corner is that deep; see `Joint.starts_in_wall`."""
        play = self.clearance
        if play is None:
            return False
        corner = np.abs(start.offset) + 0.5 * play.length * np.abs(np.sin(start.tilt))
        found: Flags = corner >= play.wall_clearance + 0.5 * play.height
        return found

    def _corner(self, clearance: SliderClearance, corner: str, by: Pair) -> Pair:
        """Return the vector from the slider's point to a corner."""
        along, side = CORNERS[corner]
        (sine, cosine), (ux, uy) = sine_cosine(self.angle), unit(self.axis)
        axis = turned((cosine * ux + sine * uy, cosine * uy - sine * ux), by)
        return plus(
            scaled(axis, 0.5 * along * clearance.length),
            scaled(left(axis), 0.5 * side * clearance.height),
        )
