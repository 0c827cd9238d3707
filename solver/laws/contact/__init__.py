"""Normal contact laws: one file a law; this roster names them, the default first."""

from jointplay.solver.laws.contact.lankarani_nikravesh import LankaraniNikravesh
from jointplay.solver.laws.contact.law import ContactLaw

LAWS: dict[str, type[ContactLaw]] = {"lankarani-nikravesh": LankaraniNikravesh}

__all__ = ["LAWS", "ContactLaw"]
