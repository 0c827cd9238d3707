"""Contact pairs: the places where the bodies of a joint with play may touch.

Each pair has a gap, a mode, an impact rate, channels and impacts of its own. A journal in its
bearing is one pair, named after its joint.
"""

from dataclasses import dataclass

from jointplay.solver.scene.document import Clearance, Joint, Revolute, Scene


@dataclass(frozen=True)
class ContactPair:
    """A place where the bodies of a joint with play may touch."""

    name: str
    """Owner of its channels and impacts: ``<joint>``."""
    joint: str
    clearance: Clearance

    @property
    def play(self) -> float:
        """How far it is from touching where it is centred, m."""
        return self.clearance.radial_clearance


def has_play(joint: Joint) -> bool:
    """Whether the bodies of a joint act on each other by contact, not by a constraint."""
    return (
        isinstance(joint, Revolute)
        and joint.clearance is not None
        and joint.clearance.radial_clearance > 0.0
    )


def pairs_of(name: str, joint: Joint) -> tuple[ContactPair, ...]:
    """Return the pairs of a joint, were its clearance above zero; none without a clearance."""
    if isinstance(joint, Revolute) and joint.clearance is not None:
        return (ContactPair(name, name, joint.clearance),)
    return ()


def contact_pairs(scene: Scene) -> dict[str, ContactPair]:
    """Return the pairs of all joints with play, by name, in the order of the document."""
    joints = {name: joint for name, joint in scene.joints.items() if has_play(joint)}
    return {pair.name: pair for name, joint in joints.items() for pair in pairs_of(name, joint)}
