"""Friction laws: one file a law; this roster names them, the default first."""

from jointplay.solver.laws.friction.law import FrictionLaw
from jointplay.solver.laws.friction.modified_coulomb import ModifiedCoulomb

LAWS: dict[str, type[FrictionLaw]] = {"modified-coulomb": ModifiedCoulomb}

__all__ = ["LAWS", "FrictionLaw"]
