"""Joints of the press whose journals have play, with the laws that they have in every benchmark."""

from typing import NamedTuple

from jointplay.solver.joints.revolute import Clearance, Revolute
from jointplay.solver.laws.contact.lankarani_nikravesh import LankaraniNikravesh
from jointplay.solver.laws.friction.modified_coulomb import ModifiedCoulomb
from jointplay.solver.scene.document import Scene


class Fit(NamedTuple):
    """A journal's play, and what acts where it touches."""

    clearance: Clearance
    contact: LankaraniNikravesh
    friction: ModifiedCoulomb


def pin(press: Scene, joint: str) -> Revolute:
    """Return a joint that must be a pin."""
    found = press.joints[joint]
    assert isinstance(found, Revolute)
    return found


def fit(press: Scene, joint: str) -> Fit:
    """Return the play of a joint, with its laws."""
    clearance = pin(press, joint).clearance
    assert clearance is not None
    contact, friction = clearance.contact, clearance.friction
    assert isinstance(contact, LankaraniNikravesh)
    assert isinstance(friction, ModifiedCoulomb)
    return Fit(clearance, contact, friction)
