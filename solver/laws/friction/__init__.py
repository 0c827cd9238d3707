"""Friction laws: one file a law; this registry names them, the default first."""

from jointplay.solver.laws.friction.bengisu_akay import BengisuAkay
from jointplay.solver.laws.friction.brown_mcphee import BrownMcPhee
from jointplay.solver.laws.friction.dahl import Dahl
from jointplay.solver.laws.friction.law import FrictionLaw
from jointplay.solver.laws.friction.lugre import LuGre
from jointplay.solver.laws.friction.modified_coulomb import ModifiedCoulomb
from jointplay.solver.laws.friction.stribeck import Stribeck
from jointplay.solver.laws.friction.threlfall import Threlfall

LAWS: dict[str, type[FrictionLaw]] = {
    "modified-coulomb": ModifiedCoulomb,
    "threlfall": Threlfall,
    "bengisu-akay": BengisuAkay,
    "stribeck": Stribeck,
    "brown-mcphee": BrownMcPhee,
    "dahl": Dahl,
    "lugre": LuGre,
}

__all__ = ["LAWS", "FrictionLaw"]
