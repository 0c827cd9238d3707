"""The largest Lyapunov exponent, with its error, from the growth of a small difference.

An integrator hands over the growth of a tangent vector, or of the distance to a companion.

Sources: Benettin, Galgani, Giorgilli and Strelcyn 1980, Meccanica 15:9 and 15:21; Müller 1995,
Chaos Solitons Fractals 5:1671 (jumps); Balcerzak et al. 2020, Mech. Syst. Signal Process.
141:106734 (companions).
"""

import math
from dataclasses import replace

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.nonlinear.batch_means import mean_estimate
from jointplay.solver.nonlinear.estimate import SIGNIFICANT, UNKNOWN, Estimate

ROUNDING = 8.0 * float(np.finfo(np.float64).eps)
"""Rounding of the logarithm of a norm, the least error of a growth: it may always be upwards."""


def exponent_from_growth(log_growth: Floats, block_time: float) -> Estimate:
    """Return the exponent, per unit of `block_time`, from growth over equal blocks of time.

    log_growth : (blocks,) natural logarithm of the factor by which the vector grew in each block.
    block_time : length of a block: in s for an exponent in 1/s, 1 for one per block.

    The first blocks, in which the vector still turns towards the direction that grows fastest, are
    left out: a tenth, or as many more, up to half, as make the standard error of the rest smallest
    (the marginal standard error rule, White 1997, Simulation 69:323). The error is that of batch
    means (`solver.nonlinear.batch_means`), and no smaller than what the length of the vector
    differs by between one instant and another, over the whole time. `drifting` says that the rest
    has not settled either, as where growth dies out like 1/t in regular motion.

    A vector that vanishes (a superstable orbit) has the exponent -inf, for certain.

    Raises
    ------
    ValueError
        If a growth is infinite or NaN, or the block time not positive.
    """
    if not 0.0 < block_time < math.inf:
        raise ValueError(f"a block takes a positive, finite time, not {block_time}")
    growth = np.asarray(log_growth, np.float64)
    if np.isnan(growth).any() or (growth == math.inf).any():
        raise ValueError("growth must be finite; shorten the blocks or start closer")
    if len(growth) == 0:
        return UNKNOWN
    if (growth == -math.inf).any():
        return Estimate(-math.inf, 0.0)
    kept = growth[_aligned(growth) :]
    end_effect = max(_end_effect(kept) / len(kept), ROUNDING)
    return mean_estimate(kept / block_time, end_effect / block_time)


def confirmed(found: Estimate, finer: Estimate) -> Estimate:
    """Return an exponent whose error counts what it differs by from one in far smaller steps.

    Of the difference, what the error of `finer` itself explains does not count.
    """
    apart = abs(found.value - finer.value)
    if not math.isfinite(apart) or not math.isfinite(finer.error):
        return found
    return replace(found, error=max(found.error, apart - finer.error))


def differs(found: Estimate, finer: Estimate) -> bool:
    """Return whether two exponents of a motion are farther apart than chance makes them."""
    apart = abs(found.value - finer.value)
    return math.isfinite(apart) and apart > SIGNIFICANT * math.hypot(found.error, finer.error)


def _aligned(growth: Floats) -> int:
    """Return how many blocks to leave out: a tenth, or where the standard error is smallest."""
    centred = (growth - growth[-1])[::-1]
    count = np.arange(1.0, len(growth) + 1.0)
    spread = np.cumsum(centred**2) - np.cumsum(centred) ** 2 / count
    marginal = (np.maximum(spread, 0.0) / count**2)[::-1]  # by the number left out
    return max(int(marginal[: len(growth) // 2 + 1].argmin()), len(growth) // 10)


def _end_effect(growth: Floats) -> float:
    """Return the standard deviation of the difference of two logarithms of length, less the trend.

    On a torus the length comes and goes but does not grow: its logarithm at the two ends is all
    that the growth consists of, and there is nothing for longer batches to average. The trend is
    that of each half, so that a drift is no end effect.
    """
    wandering = [np.cumsum(half - half.mean()) for half in np.array_split(growth, 2) if len(half)]
    variance = sum(float(((w - w.mean()) ** 2).sum()) for w in wandering) / len(growth)
    return math.sqrt(2.0 * variance)
