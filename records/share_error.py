"""The error of a share of independent trials."""

import numpy as np

from jointplay.records.arrays import Floats, Integers


def share_error(counts: Integers | int, trials: Integers | int) -> Floats:
    """Return the standard error of the share counts / trials, NaN where there are none.

    That is half the width of Wilson's interval of one standard deviation (Wilson 1927, Journal of
    the American Statistical Association 22:209, with z = 1). For many trials it is the binomial
    one; where all or none of n came out alike it is 1 / (2 n + 2), and not 0.
    """
    with np.errstate(invalid="ignore"):
        variance = np.asarray(counts) * (np.asarray(trials) - counts) / trials
    return np.asarray(np.sqrt(variance + 0.25) / (np.asarray(trials) + 1.0), np.float64)
