"""Instants at which a contact lasts whose latched impact rate companions do not agree on.

A law with memory keeps the rate of the last onset, and the motion depends on it. Where that onset
was a grazing one, its rate does not follow the tolerance: each companion has drawn one of its own,
and how far they are apart does not tell how far they are from the true one.
"""

import warnings

import numpy as np

from jointplay.records.arrays import Flags
from jointplay.solver.runs.certificate.companions import (
    PERTURBED,
    RUN,
    TIGHTER,
    TIGHTEST,
    TWIN,
    Companions,
)

AGREED = 1.1
"""Largest ratio of rates that companions agree on."""
NO_LOOSER = (TIGHTEST, TIGHTER, *PERTURBED, TWIN)


def drawn_rates(companions: Companions) -> Flags:
    """Return at which instants, (instants,), a latched rate is a draw.

    A companion that has not reached an instant does not count there.
    """
    bundle, count = companions.bundle, companions.compared
    row, pairs = bundle.kernel.row, len(bundle.kernel.pairs)
    latching = bundle.lane(RUN)["impact_floor"] > 0.0 if pairs else np.zeros(0, bool)
    rates = np.full((len(NO_LOOSER), count, pairs), np.nan)
    for i, lane in enumerate(NO_LOOSER):
        rows = companions.dense(lane)[:count]
        touching = rows[:, row.mode : row.mode + pairs] > 0.0
        found = rows[:, row.impact_rate : row.impact_rate + pairs]
        rates[i, : len(rows)] = np.where(touching, found, np.nan)
    with warnings.catch_warnings():  # of instants at which no companion touches
        warnings.simplefilter("ignore", RuntimeWarning)
        drawn = np.nanmax(rates, axis=0) > AGREED * np.nanmin(rates, axis=0)
    return np.asarray((drawn & latching).any(axis=1))
