"""The spread of what fits equally well: candidates spread evenly over all that cost little enough.

Differential evolution Markov chains (ter Braak 2006, Statistics and Computing 16:239)
with a target that is even over {cost <= level} and nothing elsewhere:
a step between two chains of one half is tried by a chain of the other half, and taken if the cost
there is within the level.  Stretched and bent valleys are followed, because steps are as long as
the valley is.

Chains begin all over the box, where the search did, and the level comes down to the limit by and by
(subset simulation, Au and Beck 2001, Probabilistic Engineering Mechanics 16:263). Chains that began
where the search ends would stay in that part of a long valley, and show no end of it.

What is as good as the best follows from the best. A chain may come across a better one than the
search did: the limit falls with it, and the level comes down again.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.calibration.document import CHAINS
from jointplay.solver.calibration.search import Cost, Found, Report

Limit = Callable[[float], float]
"""Takes the lowest cost, returns the highest that is as good."""

LONG_STEPS = 10
"""Generations between steps of full length, from one end of a set to the other."""
STIR = 1e-4
"""Standard deviation of what is added to each step, so that no direction is closed."""
LEFT, FEW = 0.6, 60
"""Share of the chains that stay when the level comes down, of so many generations or fewer; of more
it comes down the slower, with the square root."""
LATEST = 2 / 3
"""Share of the generations in which the level comes down, at most."""
WITHIN = 0.6
"""Share of the candidates kept that a lower limit must leave, else they are gathered anew."""
SETTLING = 4
"""The first 1 / SETTLING of the generations at the limit is left out."""
SETTLED = 0.5
"""Variance of the chains' means, in that within chains, below which the spread has settled; this is
a ratio of 1.22 by Gelman and Rubin 1992, Statistical Science 7:457."""


@dataclass(frozen=True, eq=False)
class EquallyGood:
    """Candidates that fit equally well.

    Attributes
    ----------
    limit : float
        Highest cost.
    best : (parameters,) float
        Coordinates of what costs least, of all that search and chains tried.
    cost : float
        Of the best.
    members : (n, parameters) float
        Coordinates from 0 to 1, spread evenly over the set; a chain that rests counts again.
    costs : (n,) float
        Of each.
    accepted : float
        Share of the steps that were taken; a few per cent mean a thin or ragged set.
    tried : int
        Candidates that were tried.
    settled : bool
        Whether each chain went through most of the set; else that may be wider than its members.
    """

    limit: float
    best: Floats
    cost: float
    members: Floats
    costs: Floats
    accepted: float
    tried: int
    settled: bool


def spread(
    cost: Cost, found: Found, limit: Limit, generations: int, seed: int, report: Report
) -> EquallyGood:
    """Spread over all candidates that are as good as the best; the same seed gives the same."""
    chains = _Chains(found, np.random.default_rng([seed, 1]))
    left = LEFT ** min(1.0, math.sqrt(FEW / generations))
    latest = min(math.ceil(LATEST * generations), generations - 1)
    level, cut_short = math.inf, False
    kept: list[Floats] = []
    kept_costs: list[Floats] = []
    for generation in range(generations):
        highest = limit(chains.lowest)
        if level > highest:
            if kept and _share(kept_costs, highest) < WITHIN:
                kept, kept_costs = [], []
            level = max(highest, float(np.quantile(chains.costs, left)))
            if generation >= latest and level > highest:
                level, cut_short = highest, True
                chains.join(found, highest)
            chains.narrow(level)
        chains.step(cost, level, generation)
        if level <= highest:
            kept.append(chains.positions.copy())
            kept_costs.append(chains.costs.copy())
        report((generation + 1) / generations, "what fits equally well")
    first, highest = len(kept) // SETTLING, limit(chains.lowest)
    positions, costs = np.array(kept[first:]), np.array(kept_costs[first:])
    within, between = positions.var(axis=0).mean(axis=0), positions.mean(axis=0).var(axis=0)
    lasting = not cut_short and _share(kept_costs[first:], highest) >= WITHIN
    good = costs <= highest
    return EquallyGood(
        highest,
        chains.best,
        chains.lowest,
        positions[good],
        costs[good],
        chains.taken / (CHAINS * generations),
        chains.tried,
        lasting and bool((between < SETTLED * within).all()),
    )


def _share(costs: list[Floats], limit: float) -> float:
    return float((np.array(costs) <= limit).mean())


class _Chains:
    """Chains in two halves."""

    def __init__(self, found: Found, generator: np.random.Generator) -> None:
        """Begin at the first candidates of the search that could be computed."""
        first = np.flatnonzero(np.isfinite(found.costs))[:CHAINS]
        index = np.resize(generator.permutation(first), CHAINS)
        self.positions: Floats = found.tried[index]
        """(CHAINS, parameters)."""
        self.costs: Floats = found.costs[index]
        self.best, self.lowest = found.best, found.cost
        """Candidate that costs least of all that were tried, and its cost."""
        self.taken = self.tried = 0
        self._generator = generator

    def join(self, found: Found, limit: float) -> None:
        """Let chains beyond a limit go on from candidates of the search that are within.

        Where none is, from the best.
        """
        good, beyond = np.flatnonzero(found.costs <= limit), np.flatnonzero(self.costs > limit)
        if not len(good):
            self.positions[beyond], self.costs[beyond] = self.best, self.lowest
            return
        index = np.resize(self._generator.permutation(good), len(beyond))
        self.positions[beyond], self.costs[beyond] = found.tried[index], found.costs[index]

    def narrow(self, level: float) -> None:
        """Let chains beyond a level go on from those within, each of which is taken as often."""
        good, beyond = np.flatnonzero(self.costs <= level), np.flatnonzero(self.costs > level)
        index = np.resize(self._generator.permutation(good), len(beyond))
        self.positions[beyond], self.costs[beyond] = self.positions[index], self.costs[index]

    def step(self, cost: Cost, level: float, generation: int) -> None:
        """Let each half try a step, and take it if its cost is within the level."""
        half = CHAINS // 2
        for first in (0, half):
            own, other = slice(first, first + half), slice(half - first, CHAINS - first)
            proposed = _proposals(
                self.positions[own], self.positions[other], generation, self._generator
            )
            inside = ((proposed >= 0.0) & (proposed <= 1.0)).all(axis=1)
            costs = np.full(half, np.inf)
            if inside.any():
                costs[inside] = cost(proposed[inside])
            good = costs <= level
            if costs.min() < self.lowest:
                self.best, self.lowest = proposed[costs.argmin()], float(costs.min())
            self.positions[own] = np.where(good[:, None], proposed, self.positions[own])
            self.costs[own] = np.where(good, costs, self.costs[own])
            self.taken += int(good.sum())
            self.tried += int(inside.sum())


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
