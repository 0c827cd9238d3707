"""Force elements between two points: one file an element; this registry names them."""

from jointplay.solver.laws.force.force import Force
from jointplay.solver.laws.force.law import Effect, Ends, ForceElement, Over
from jointplay.solver.laws.force.motor import Motor
from jointplay.solver.laws.force.spring_damper import SpringDamper
from jointplay.solver.laws.force.tension import Tension
from jointplay.solver.laws.force.torque import Torque
from jointplay.solver.laws.force.torsion_spring import TorsionSpring

ELEMENTS: dict[str, type[ForceElement]] = {
    "spring-damper": SpringDamper,
    "torsion-spring": TorsionSpring,
    "force": Force,
    "tension": Tension,
    "torque": Torque,
    "motor": Motor,
}

__all__ = ["ELEMENTS", "Effect", "Ends", "ForceElement", "Over"]
