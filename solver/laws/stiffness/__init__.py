"""Stiffness laws: the elastic part of a contact; one file a law, this registry names them."""

from jointplay.solver.laws.stiffness.dubowsky_freudenstein import DubowskyFreudenstein
from jointplay.solver.laws.stiffness.esdu_78035 import Esdu78035
from jointplay.solver.laws.stiffness.goldsmith import Goldsmith
from jointplay.solver.laws.stiffness.hertz_spheres import HertzSpheres
from jointplay.solver.laws.stiffness.johnson import Johnson
from jointplay.solver.laws.stiffness.law import Stiffness
from jointplay.solver.laws.stiffness.liu import Liu
from jointplay.solver.laws.stiffness.pereira import Pereira
from jointplay.solver.laws.stiffness.power import Power
from jointplay.solver.laws.stiffness.radzimovsky import Radzimovsky

LAWS: dict[str, type[Stiffness]] = {
    "hertz-spheres": HertzSpheres,
    "power": Power,
    "johnson": Johnson,
    "radzimovsky": Radzimovsky,
    "goldsmith": Goldsmith,
    "dubowsky-freudenstein": DubowskyFreudenstein,
    "esdu-78035": Esdu78035,
    "pereira": Pereira,
    "liu": Liu,
}

__all__ = ["LAWS", "Stiffness"]
