"""Normal contact laws: one file a law; this roster names them.

A law module offers `contact_stiffness`, `normal_force` and `elastic_energy` on abstract scalars.
"""

from types import ModuleType

from jointplay.solver.laws.contact import lankarani_nikravesh
from jointplay.solver.laws.contact.lankarani_nikravesh import LankaraniNikravesh

ContactLaw = LankaraniNikravesh
LAWS: dict[str, ModuleType] = {"lankarani-nikravesh": lankarani_nikravesh}
