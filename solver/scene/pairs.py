"""Contact pairs: where the bodies of a joint with play may touch.

Each pair has a gap, a mode, an impact rate, channels and impacts of its own. A journal in its
bearing is one pair, named after its joint; a slider has one at each corner, ``<joint>.corner_1`` to
``<joint>.corner_4``, numbered as the quadrants of its axis and the direction to the left of that; a
pin in a slot has ``<joint>.wall_1`` to the left of the axis and ``<joint>.wall_2`` to the right. A
cam and its follower are one pair, named after their joint.
"""

from collections.abc import Mapping
from dataclasses import dataclass

from jointplay.solver.joints import Joint
from jointplay.solver.joints.joint import AnyClearance
from jointplay.solver.scene.document import Scene


@dataclass(frozen=True)
class ContactPair:
    """Two surfaces of the bodies of a joint with play that may touch."""

    joint: str
    part: str
    """Name among the joint's pairs; empty where there is one."""
    of: Joint
    """The joint itself."""

    @property
    def name(self) -> str:
        """Owner of its channels and impacts: ``<joint>`` or ``<joint>.<part>``."""
        return f"{self.joint}.{self.part}" if self.part else self.joint

    @property
    def clearance(self) -> AnyClearance:
        """The joint's clearance."""
        found = self.of.slack
        assert found is not None  # noqa: S101  (else it has no pairs)
        return found

    @property
    def is_journal(self) -> bool:
        """True for a journal in its bearing, false for a point at a wall, or at a cam."""
        return self.of.is_journal

    @property
    def play(self) -> float:
        """Distance from touching where it is centred, m."""
        found: float = self.clearance.play
        return found

    @property
    def loosened(self) -> Mapping[str, float]:
        """Largest violation of the joint's constraints, m or rad, by part of the constraint."""
        return self.of.loosened

    @property
    def size(self) -> float:
        """Length of what touches, m: radius of bearing, pin or cam, half a slider's diagonal."""
        return self.of.size


def pairs_of(name: str, joint: Joint) -> tuple[ContactPair, ...]:
    """Return the pairs of a joint, were its clearance above zero; none without a clearance."""
    if joint.slack is None:
        return ()
    return tuple(ContactPair(name, part, joint) for part in joint.parts)


def contact_pairs(scene: Scene) -> dict[str, ContactPair]:
    """Return the pairs of all joints with play, by name, in the order of the document."""
    joints = {name: joint for name, joint in scene.joints.items() if joint.has_play}
    return {pair.name: pair for name, joint in joints.items() for pair in pairs_of(name, joint)}
