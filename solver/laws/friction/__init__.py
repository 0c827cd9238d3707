"""Friction laws: one file a law; this roster names them.

A law module offers `friction_force` on abstract scalars.
"""

from types import ModuleType

from jointplay.solver.laws.friction import modified_coulomb
from jointplay.solver.laws.friction.modified_coulomb import ModifiedCoulomb

FrictionLaw = ModifiedCoulomb
LAWS: dict[str, ModuleType] = {"modified-coulomb": modified_coulomb}
