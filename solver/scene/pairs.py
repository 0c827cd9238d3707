"""Contact pairs: the places where the bodies of a joint with play may touch.

Each pair has a gap, a mode, an impact rate, channels and impacts of its own. A journal in its
bearing is one pair, named after its joint; a slider has one at each corner, ``<joint>.corner_1`` to
``<joint>.corner_4``, numbered as the quadrants of its axis and the direction to the left of that; a
pin in a slot has ``<joint>.wall_1`` to the left of the axis and ``<joint>.wall_2`` to the right. A
cam and its follower are one pair, named after their joint.
"""

import math
from dataclasses import dataclass

from jointplay.solver.scene.cams import CamClearance, CamJoint
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.joints import (
    Clearance,
    Fixed,
    Joint,
    PinClearance,
    PinInSlot,
    Prismatic,
    Revolute,
    SliderClearance,
)

AnyClearance = Clearance | SliderClearance | PinClearance | CamClearance

CORNERS = {"corner_1": (1.0, 1.0), "corner_2": (-1.0, 1.0)}
CORNERS |= {"corner_3": (-1.0, -1.0), "corner_4": (1.0, -1.0)}
"""Places of a slider's corners along the axis and across it, in halves of its length and height."""
WALLS = {"wall_1": 1.0, "wall_2": -1.0}
"""Side of a slot's axis on which each wall is."""


@dataclass(frozen=True)
class ContactPair:
    """A place where the bodies of a joint with play may touch."""

    joint: str
    part: str
    """Name among the joint's pairs; empty where there is one."""
    clearance: AnyClearance
    cam: CamJoint | None = None
    """The joint, where it is a cam's."""

    @property
    def name(self) -> str:
        """Owner of its channels and impacts: ``<joint>`` or ``<joint>.<part>``."""
        return f"{self.joint}.{self.part}" if self.part else self.joint

    @property
    def is_journal(self) -> bool:
        """True for a journal in its bearing, false for a point at a wall, or at a cam."""
        return isinstance(self.clearance, Clearance)

    @property
    def play(self) -> float:
        """Distance from touching where it is centred, m."""
        return play_of(self.clearance)

    @property
    def loosened(self) -> dict[str, float]:
        """Largest violation of the joint's constraints, m or rad, by part of the constraint."""
        if isinstance(self.clearance, Clearance):
            return {"x": self.play, "y": self.play}
        if isinstance(self.clearance, PinClearance | CamClearance):
            return {"normal": self.play}
        return {"normal": self.play, "angle": 2.0 * self.play / self.clearance.length}

    @property
    def size(self) -> float:
        """Length of what touches, m: radius of bearing, pin or cam, half a slider's diagonal."""
        if isinstance(self.clearance, Clearance):
            return self.clearance.bearing_radius
        if isinstance(self.clearance, PinClearance):
            return self.clearance.pin_radius
        if isinstance(self.clearance, CamClearance):
            assert self.cam is not None  # noqa: S101  (narrows the type)
            return largest_radius(self.cam)
        return 0.5 * math.hypot(self.clearance.length, self.clearance.height)


def largest_radius(joint: CamJoint) -> float:
    """Return a bound on a profile, m: its value at zero, and what it gains from there at most."""
    slope = next(iter(joint.profile.largest(2.0 * math.pi)), 0.0)
    return abs(float(joint.profile.at(0.0).value)) + math.pi * slope


def play_of(clearance: AnyClearance) -> float:
    """Return how far centred bodies are from touching, m."""
    if isinstance(clearance, Clearance):
        return clearance.radial_clearance
    if isinstance(clearance, CamClearance):
        return clearance.lash
    return clearance.wall_clearance


def has_play(joint: Joint) -> bool:
    """Tell whether the bodies of a joint act on each other by contact, not by a constraint."""
    if isinstance(joint, Fixed) or joint.clearance is None:
        return False
    return bool(play_of(joint.clearance) > 0.0)


def pairs_of(name: str, joint: Joint) -> tuple[ContactPair, ...]:
    """Return the pairs of a joint, were its clearance above zero; none without a clearance."""
    if isinstance(joint, Revolute) and joint.clearance is not None:
        return (ContactPair(name, "", joint.clearance),)
    if isinstance(joint, Prismatic) and joint.clearance is not None:
        return tuple(ContactPair(name, corner, joint.clearance) for corner in CORNERS)
    if isinstance(joint, PinInSlot) and joint.clearance is not None:
        return tuple(ContactPair(name, wall, joint.clearance) for wall in WALLS)
    if isinstance(joint, CamJoint) and joint.clearance is not None:
        return (ContactPair(name, "", joint.clearance, joint),)
    return ()


def contact_pairs(scene: Scene) -> dict[str, ContactPair]:
    """Return the pairs of all joints with play, by name, in the order of the document."""
    joints = {name: joint for name, joint in scene.joints.items() if has_play(joint)}
    return {pair.name: pair for name, joint in joints.items() for pair in pairs_of(name, joint)}
