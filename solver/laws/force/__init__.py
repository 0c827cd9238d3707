"""Force elements between two points: one file an element; this roster names them."""

from jointplay.solver.laws.force.law import Effect, Ends, ForceElement
from jointplay.solver.laws.force.spring_damper import SpringDamper
from jointplay.solver.laws.force.torque import Torque

ELEMENTS: dict[str, type[ForceElement]] = {"spring-damper": SpringDamper, "torque": Torque}

__all__ = ["ELEMENTS", "Effect", "Ends", "ForceElement"]
