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
from jointplay.solver.quantities.scalars import logarithm

ROUNDING = 8.0 * float(np.finfo(np.float64).eps)
"""Rounding of the logarithm of a norm, the least error of a growth: it may always be upwards."""


def exponent_from_growth(log_growth: Floats, block_time: float, before: float = 0.0) -> Estimate:
    """Return the exponent, per unit of `block_time`, from growth over equal blocks of time.

    log_growth : (blocks,) natural logarithm of the factor by which the vector grew in each block.
    block_time : length of a block: in s for an exponent in 1/s, 1 for one per block.
    before : blocks since the vector's start before the first of these.

    The first blocks, in which the vector still turns towards the direction that grows fastest, are
    left out: a tenth, or as many more, up to half, as make the standard error of the rest smallest
    (the marginal standard error rule, White 1997, Simulation 69:323). The error is that of batch
    means (`solver.nonlinear.batch_means`), and no smaller than what the length of the vector
    differs by between one instant and another, over the whole time. `drifting` says that the rest
    has not settled either, as where growth dies out like 1/t in regular motion: a vector that grows
    like t, such as the angle of a body that spins freely, has the exponent zero, but ln t grows in
    any record. An exponent of up to three times what t alone would give is no more certain.

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
    left_out = _aligned(growth)
    kept = growth[left_out:]
    end_effect = max(_end_effect(kept) / len(kept), ROUNDING)
    found = mean_estimate(kept / block_time, end_effect / block_time)
    since = before + left_out
    linear = logarithm((before + len(growth)) / max(since, 1.0)) / (len(kept) * block_time)
    if 0.0 < found.value <= SIGNIFICANT * linear:
        return replace(found, error=max(found.error, linear))
    return found


def in_smaller_steps(log_growth: Floats, finer_growth: Floats, block_time: float) -> Estimate:
    """Return the exponent from a stretch in smaller steps, with the error of so short a stretch.

    log_growth, finer_growth : (blocks,) of the record, and of the stretch behind it, which is no
        longer. A stretch has too few blocks to tell its own error; that is how far the record's
        means scatter over as many blocks as are kept of it, at least the record's own error over
        the root of the share.
    """
    record = exponent_from_growth(log_growth, block_time)
    found = exponent_from_growth(finer_growth, block_time)
    if not math.isfinite(found.value) or not math.isfinite(record.value):
        return UNKNOWN
    kept = log_growth[_aligned(log_growth) :]
    blocks = len(finer_growth) - _aligned(finer_growth)
    error = record.error * math.sqrt(len(kept) / blocks)
    if len(kept) > blocks:
        total = np.cumsum(np.concatenate([[0.0], kept]))
        means = (total[blocks:] - total[:-blocks]) / (blocks * block_time)
        error = max(error, float(means.std()))
    return Estimate(found.value, error)


def confirmed(found: Estimate, finer: Estimate) -> Estimate:
    """Return an exponent with the error of its steps: what smaller ones differ by.

    It is no better known than they are: a difference may be small by chance.
    """
    apart = abs(found.value - finer.value)
    if not math.isfinite(apart):
        return found
    return replace(found, error=max(found.error, apart, finer.error))


def contradicts(finer: Estimate, found: Estimate) -> bool:
    """Return whether smaller steps give another exponent.

    They differ by more than three errors, and by more than a third of the exponent.
    """
    apart = abs(found.value - finer.value)
    significant = apart > SIGNIFICANT * math.hypot(found.error, finer.error)
    return math.isfinite(apart) and significant and abs(found.value) < SIGNIFICANT * apart


def undecided(found: Estimate, finer: Estimate) -> bool:
    """Return whether neighbours part in the record, and smaller steps neither agree nor deny it."""
    open_still = not finer.exceeds(0.0) and not contradicts(finer, found)
    return math.isfinite(finer.value) and found.exceeds(0.0) and open_still


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
