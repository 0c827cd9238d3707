"""Starts of joints with play: where in its play what has some is."""

from typing import Annotated

from pydantic import Field

from jointplay.solver.quantities.units import Angle, AngularVelocity, Length, Strict, Velocity


class JournalStart(Strict):
    """A journal's start in its bearing, in world axes: its centre less the bearing's.

    Without a rate it moves as the velocities of the bodies say, else not. A journal that starts in
    contact has its rate of penetration as impact rate, or the floor of that if it is larger.
    """

    eccentricity: Annotated[list[Length], Field(min_length=2, max_length=2)] = [0.0, 0.0]
    rate: Annotated[list[Velocity], Field(min_length=2, max_length=2)] | None = None


class GuideStart(Strict):
    """A start of a slider, a pin or a follower off the middle of its play.

    `offset` is how far its point is to the left of the axis, or of a follower away from its
    profile; `tilt` the angle of a slider's body less that of the centred one; `rate` and
    `tilt_rate` are how fast these grow. Without a rate it moves as the velocities of the bodies
    say, else not.
    """

    offset: Length = 0.0
    tilt: Angle = 0.0
    rate: Velocity | None = None
    tilt_rate: AngularVelocity | None = None
