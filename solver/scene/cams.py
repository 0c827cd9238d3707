"""Cams of a scene: joints in which a profile moves a follower, with play or without."""

import math
from typing import Annotated, Literal

from pydantic import AfterValidator

from jointplay.solver.laws.contact import LAWS as CONTACT_LAWS
from jointplay.solver.laws.contact import ContactLaw
from jointplay.solver.laws.friction import LAWS as FRICTION_LAWS
from jointplay.solver.laws.friction import FrictionLaw
from jointplay.solver.laws.function import Function
from jointplay.solver.laws.function.uses import Prescribed
from jointplay.solver.quantities.roster import MemberOf
from jointplay.solver.quantities.units import (
    Direction,
    PointReference,
    RadialClearance,
    Radius,
    Strict,
)

TURN = 2.0 * math.pi
NEARLY = 1e-6
"""Mismatch within which knots that repeat are meant to do so after a turn: 2 pi to seven digits."""


def whole_turn(profile: Function) -> Function:
    """Return a profile whose last knot ends a turn, or an equal share of it, to rounding.

    One whose knots do so within `NEARLY` has the last one moved there.
    """
    knots = getattr(profile, "knots", None)
    if not knots or getattr(profile, "outside", "") != "periodic" or not knots[-1] > knots[0]:
        return profile
    share = TURN / max(round(TURN / (knots[-1] - knots[0])), 1)
    if abs(knots[-1] - knots[0] - share) > NEARLY * share:
        return profile
    moved = profile.model_copy(update={"knots": [*knots[:-1], knots[0] + share]})
    return profile if any(rule.broken(moved) for rule in profile.rules) else moved


class CamClearance(Strict):
    """Play of a follower, which strikes its cam and may lift off.

    The cam's surface is `lash` inside of the profile, along its normal. A lash of zero is an ideal
    joint.
    """

    lash: RadialClearance
    contact: Annotated[ContactLaw, MemberOf(CONTACT_LAWS, "law")]
    friction: Annotated[FrictionLaw, MemberOf(FRICTION_LAWS, "law")] | None = None


class CamJoint(Strict):
    """A cam and its follower: two points, and how far they are apart where both touch.

    `profile` is a function of an angle in the cam's axes, rad, that repeats after a turn: base
    radius and lift, m. A last knot within a millionth of a turn is taken to end it.
    """

    type: str
    cam: PointReference
    follower: PointReference
    profile: Annotated[Prescribed, AfterValidator(whole_turn)]
    clearance: CamClearance | None = None


class FlatFollower(CamJoint):
    """A flat face, through the follower's point, on a convex cam.

    `normal` points out of the cam, in the follower's axes. The profile is the distance of the face
    from the cam's centre, over the direction of that normal.
    """

    type: Literal["flat-follower"]
    normal: Direction


class RollerFollower(CamJoint):
    """A roller about the follower's point, on a cam.

    The profile is the distance of the roller's centre from the cam's, over the direction in which
    it lies.
    """

    type: Literal["roller-follower"]
    roller_radius: Radius
