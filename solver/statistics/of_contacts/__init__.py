"""Statistics of the contacts of joints with clearance; one file a member, named by this roster."""

from jointplay.solver.statistics.of_contacts.impact_count import ImpactCount
from jointplay.solver.statistics.of_contacts.impact_force import LargestImpactForce
from jointplay.solver.statistics.of_contacts.share import ContactShare
from jointplay.solver.statistics.of_contacts.statistic import ContactStatistic

OF_CONTACTS: dict[str, ContactStatistic] = {
    "impacts": ImpactCount(),
    "largest_impact_force": LargestImpactForce(),
    "contact_share": ContactShare(),
}

__all__ = ["OF_CONTACTS", "ContactStatistic"]
