"""The spread of what fits equally well: candidates spread evenly over all that cost little enough.

Differential evolution Markov chains (ter Braak 2006, Statistics and Computing 16:239)
with a target that is even over {cost <= limit} and nothing elsewhere:
a step between two chains of one half is tried by a chain of the other half, and taken if the cost
there is within the limit.  Stretched and bent valleys are followed, because steps are as long as
the valley is.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.calibration.document import CHAINS
from jointplay.solver.calibration.search import Cost, Found, Report

LONG_STEPS = 10
"""Generations between steps of full length, from one end of a set to the other."""
STIR = 1e-4
"""Standard deviation of what is added to each step, so that no direction is closed."""
SETTLING = 4
"""The first 1 / SETTLING of the generations is left out: there chains come from the search."""


@dataclass(frozen=True, eq=False)
class EquallyGood:
    """Candidates that fit equally well.

    Attributes
    ----------
    limit : float
        Highest cost.
    members : (n, parameters) float
        Coordinates from 0 to 1, spread evenly over the set; a chain that rests counts again.
    costs : (n,) float
        Of each.
    accepted : float
        Share of the steps that were taken; a few per cent mean a thin or ragged set.
    tried : int
        Candidates that were tried.
    """

    limit: float
    members: Floats
    costs: Floats
    accepted: float
    tried: int

    def within(self, limit: float) -> EquallyGood:
        """Return those whose cost is at most a lower limit."""
        good = self.costs <= limit
        return replace(self, limit=limit, members=self.members[good], costs=self.costs[good])


def spread(
    cost: Cost, found: Found, limit: float, generations: int, seed: int, report: Report
) -> EquallyGood:
    """Spread over all candidates whose cost is at most `limit`; the same seed gives the same."""
    generator = np.random.default_rng([seed, 1])
    chains, now = _begin(found, limit, generator)
    kept: list[Floats] = []
    kept_costs: list[Floats] = []
    taken = tried = 0
    half = CHAINS // 2
    for generation in range(generations):
        for first in (0, half):
            own, other = slice(first, first + half), slice(half - first, CHAINS - first)
            proposed = _proposals(chains[own], chains[other], generation, generator)
            inside = ((proposed >= 0.0) & (proposed <= 1.0)).all(axis=1)
            costs = np.full(half, np.inf)
            if inside.any():
                costs[inside] = cost(proposed[inside])
            good = costs <= limit
            chains[own] = np.where(good[:, None], proposed, chains[own])
            now[own] = np.where(good, costs, now[own])
            taken, tried = taken + int(good.sum()), tried + int(inside.sum())
        if generation >= generations // SETTLING:
            kept.append(chains.copy())
            kept_costs.append(now.copy())
        report((generation + 1) / generations, "what fits equally well")
    share = taken / (CHAINS * generations)
    return EquallyGood(limit, np.concatenate(kept), np.concatenate(kept_costs), share, tried)


def _begin(found: Found, limit: float, generator: np.random.Generator) -> tuple[Floats, Floats]:
    """Start the chains from what the search tried, as far apart as it goes; the best repeated."""
    good = np.flatnonzero(found.costs <= limit)
    chosen = generator.permutation(good)[:CHAINS]
    rest = np.full(CHAINS - len(chosen), int(found.costs.argmin()), np.int64)
    index = generator.permutation(np.concatenate([chosen, rest]))
    return found.tried[index].copy(), found.costs[index].copy()


def _proposals(
    own: Floats, other: Floats, generation: int, generator: np.random.Generator
) -> Floats:
    """Return a step for each chain of one half: the difference of two chains of the other."""
    count, parameters = own.shape
    first = generator.integers(len(other), size=count)
    second = (first + generator.integers(1, len(other), size=count)) % len(other)
    length = 2.38 / math.sqrt(2.0 * parameters)  # optimal for a normal target (ter Braak 2006)
    factor = 1.0 if generation % LONG_STEPS == LONG_STEPS - 1 else length
    stir = STIR * generator.standard_normal((count, parameters))
    return np.asarray(own + factor * (other[first] - other[second]) + stir, np.float64)
