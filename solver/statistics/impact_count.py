"""Count of contacts that began."""

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.statistics.statistic import Contacts, ContactStatistic


class ImpactCount(ContactStatistic):
    """Onsets after the start of the stretch."""

    unit = "1"
    long_name = "beginnings of contact"

    def add(self, tally: Floats, contacts: Contacts, start: float, end: float) -> None:
        """Count the onsets."""
        np.add.at(tally, contacts["joint"][contacts["onset"] > start], 1.0)
