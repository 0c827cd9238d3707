"""The largest normal force of an impact: of a contact that began in the stretch, not before."""

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.statistics.statistic import Contacts, ContactStatistic


class LargestImpactForce(ContactStatistic):
    """N; zero if no contact began."""

    unit = "N"
    long_name = "largest normal force of a contact that began; 0: none did"

    def add(self, tally: Floats, contacts: Contacts, start: float, end: float) -> None:
        """Take the peaks of the new contacts."""
        begun = contacts[contacts["onset"] > start]
        np.maximum.at(tally, begun["joint"], begun["peak_force"])
