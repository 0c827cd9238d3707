"""Normal contact laws: one file a law; this registry names them, the default first."""

from jointplay.solver.laws.contact.adams_impact import AdamsImpact
from jointplay.solver.laws.contact.lankarani_nikravesh import LankaraniNikravesh
from jointplay.solver.laws.contact.law import ContactLaw
from jointplay.solver.laws.contact.long_bearing_film import LongBearingFilm
from jointplay.solver.laws.contact.short_bearing_film import ShortBearingFilm
from jointplay.solver.laws.contact.stiffness_and_dissipation import StiffnessAndDissipation

LAWS: dict[str, type[ContactLaw]] = {
    "lankarani-nikravesh": LankaraniNikravesh,
    "stiffness-and-dissipation": StiffnessAndDissipation,
    "adams-impact": AdamsImpact,
    "short-bearing-film": ShortBearingFilm,
    "long-bearing-film": LongBearingFilm,
}

__all__ = ["LAWS", "ContactLaw"]
