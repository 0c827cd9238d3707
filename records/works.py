"""Works of a run over time: terms of its energy ledger that are no function of its state."""

from typing import Final

WORKS: Final = ("contact_loss", "friction_loss", "element_loss", "driver_work")
"""Names of the terms, as the ledger of a run has them: what contacts, friction and force elements
took, and what drivers gave, J."""
