"""The share of the time in contact."""

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.statistics.statistic import Contacts, ContactStatistic


class ContactShare(ContactStatistic):
    """0 to 1."""

    unit = "1"
    long_name = "share of the time in contact, 0 to 1"

    def add(self, tally: Floats, contacts: Contacts, start: float, end: float) -> None:
        """Add how long each contact lasted inside the stretch, one after the other."""
        release = np.where(np.isnan(contacts["release"]), end, contacts["release"])
        lasted = np.minimum(release, end) - np.maximum(contacts["onset"], start)
        np.add.at(tally, contacts["joint"], np.maximum(lasted, 0.0))

    def value(self, tally: Floats, start: float, end: float) -> Floats:
        """Return the share."""
        return np.asarray(tally / (end - start), np.float64)
