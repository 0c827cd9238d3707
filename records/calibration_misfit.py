"""Whether a calibration's best set fits at all, and whether it lies at the end of a range."""

import math
from collections.abc import Mapping
from typing import Any

RARELY = 3.0902
"""Standard deviations of a normal number that one in a thousand exceeds."""
AT_THE_END = 1e-3
"""Share of a parameter's range, in its spacing, within which the best is at an end of it."""


def misfits(document: Mapping[str, Any]) -> bool:
    """Return whether misses are larger than errors of the size of the tolerances explain.

    The sum of their squares then exceeds what one in a thousand sums of as many squares of normal
    numbers does (Wilson and Hilferty 1931, Proc. Natl. Acad. Sci. 17:684): the model, a tolerance
    or a range is not right.

    Parameters
    ----------
    document
        What a calibration found, as `jointplay calibrate -o` writes it.
    """
    count = sum(target["weight"] > 0.0 for target in document["targets"])
    spread = 2.0 / (9.0 * count)
    return bool(document["cost"] ** 2 > (1.0 - spread + RARELY * math.sqrt(spread)) ** 3)


def with_misfits(document: Mapping[str, Any]) -> dict[str, Any]:
    """Return what a calibration found, with ``misfits``: whether nothing fits."""
    return {**document, "misfits": misfits(document)}


def best_at(document: Mapping[str, Any], parameter: Mapping[str, Any]) -> str:
    """Return the end of its range at which a parameter is best, minimum or maximum; else empty.

    `parameter` : one of the document's.
    """
    free = document["calibration"]["parameters"][parameter["name"]]
    low, high, best = free["minimum"], free["maximum"], parameter["best"]
    if free["spacing"] == "log":
        low, high, best = math.log(low), math.log(high), math.log(best)
    share = (best - low) / (high - low)
    return "minimum" if share <= AT_THE_END else "maximum" if share >= 1.0 - AT_THE_END else ""
