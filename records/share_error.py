"""The error of a share of trials, which are independent or of starts that are."""

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


def error_of_starts(counts: Integers, trials: Integers) -> float:
    """Return the standard error of a share where each start is tried at several values.

    Starts are independent, trials of one start are not: at neighbouring values most end alike. So
    the error is from how the shares of starts scatter, weighted by their trials (ratio estimator,
    Cochran 1977, Sampling Techniques, 3rd ed., 6.5). With one trial each it is `share_error`.

    Parameters
    ----------
    counts, trials
        (starts,) of each start; one without trials does not count. NaN where none has any.
    """
    counts, trials = counts[trials > 0], trials[trials > 0]
    starts, total = len(trials), int(trials.sum())
    if not starts:
        return float("nan")
    apart = (counts - counts.sum() / total * trials) * (starts / total)
    return float(np.sqrt(np.sum(apart * apart) + 0.25) / (starts + 1.0))
