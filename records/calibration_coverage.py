"""Coverage of what fits equally well: how often it has the true value of a parameter."""

import math
from collections.abc import Mapping
from typing import Any


def coverage(document: Mapping[str, Any]) -> float | None:
    """Return how often a parameter's lowest to highest value has the true one, 0 to 1.

    Of n readings, each with an independent normal error whose standard deviation is its tolerance:
    what fits equally well costs at most n (limit^2 - cost^2) more in the sum of squares, and this
    is a square of one normal number where values are linear in the parameters (profile likelihood,
    Venzon and Moolgavkar 1988, Applied Statistics 37:87). None: targets that are ranges, or have
    different weights, are no such readings.

    Parameters
    ----------
    document
        What a calibration found, as `jointplay calibrate -o` writes it.
    """
    fitted = [target for target in document["targets"] if target["weight"] > 0.0]
    if len({target["weight"] for target in fitted}) != 1:
        return None
    if any(target["between"] is not None for target in fitted):
        return None
    limit, cost = document["equally_good_cost"], document["cost"]
    return math.erf(math.sqrt(0.5 * len(fitted) * max(limit * limit - cost * cost, 0.0)))
