"""Steps of a run whose method changed: stretches of one method, and their answers as one."""

from collections.abc import Sequence

import numpy as np

from jointplay.records.arrays import Floats


def stretches(numbers: Floats) -> list[slice]:
    """Return where numbers of methods (n,), one a step, stay the same, in their order."""
    ends = [*(np.flatnonzero(np.diff(numbers)) + 1).tolist(), len(numbers)]
    return [slice(first, last) for first, last in zip([0, *ends[:-1]], ends, strict=True)]


def spread(times: Floats, begins: Sequence[float]) -> list[Floats]:
    """Return the ascending times (m,), s, that each stretch answers for: those before the next."""
    return np.split(times, np.searchsorted(times, np.array(begins[1:]), side="left"))


def widest(records: Sequence[Floats]) -> Floats:
    """Return the extremes (bins, names, 4) of stretches as one; NaN counts for nothing."""
    found = records[0].copy()
    for each in records[1:]:
        for value, sense in ((0, 1.0), (2, -1.0)):
            with np.errstate(invalid="ignore"):
                better = sense * each[..., value] < sense * found[..., value]
            better |= np.isnan(found[..., value])
            found[better, value : value + 2] = each[better, value : value + 2]
    return found
