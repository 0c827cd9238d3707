"""Joints between bodies: one file a type; this registry names them. Gears couple two that turn."""

from jointplay.solver.joints.fixed import Fixed
from jointplay.solver.joints.flat_follower import FlatFollower
from jointplay.solver.joints.gear import Gear
from jointplay.solver.joints.joint import Joint
from jointplay.solver.joints.pin_in_slot import PinInSlot
from jointplay.solver.joints.prismatic import Prismatic
from jointplay.solver.joints.revolute import Revolute
from jointplay.solver.joints.roller_follower import RollerFollower

JOINTS: dict[str, type[Joint]] = {
    "revolute": Revolute,
    "prismatic": Prismatic,
    "pin-in-slot": PinInSlot,
    "flat-follower": FlatFollower,
    "roller-follower": RollerFollower,
    "fixed": Fixed,
}

__all__ = ["JOINTS", "Gear", "Joint"]
