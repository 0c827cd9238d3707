"""The search for what fits best: differential evolution, a generation at a time.

Storn and Price 1997, as scipy.optimize has it (best1bin, from a Latin hypercube).  It compares
costs and takes no derivatives: where impacts follow one another, the cost of neighbours differs
by more than a derivative could say.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.calibration.document import Search

if TYPE_CHECKING:
    from scipy.optimize import OptimizeResult

Cost = Callable[[Floats], Floats]
"""Takes coordinates (n, parameters) from 0 to 1, returns costs (n,)."""
Report = Callable[[float, str], None]
"""Takes the fraction of the whole that is done, and a few words."""

ALIKE, NOTHING = 0.01, 1e-3
"""The search ends when the costs of a generation spread by no more than this share of their mean,
or by this (in tolerances)."""


@dataclass(frozen=True, eq=False)
class Found:
    """Result of a search.

    Attributes
    ----------
    best : (parameters,) float
        Coordinates from 0 to 1.
    cost : float
        Of the best.
    tried : (n, parameters) float
        Every candidate, in the order of trying.
    costs : (n,) float
        Of each; infinite where a run failed.
    generations : int
        That were bred.
    settled : bool
        Whether it ended because all candidates had become alike.
    """

    best: Floats
    cost: float
    tried: Floats
    costs: Floats
    generations: int
    settled: bool

    def best_costs(self) -> Floats:
        """Return (generations + 1,): the lowest cost after each generation, the first included."""
        return np.minimum.accumulate(self.costs.reshape(self.generations + 1, -1).min(axis=1))


def search(cost: Cost, parameters: int, settings: Search, report: Report) -> Found:
    """Search the unit cube; the same seed finds the same.

    `report` is called after every generation.
    """
    # a seventh of the time in which workers start, which calibrations alone need
    from scipy.optimize import Bounds, differential_evolution

    tried: list[Floats] = []
    costs: list[Floats] = []

    def vectorised(columns: Floats) -> Floats:
        candidates = np.ascontiguousarray(columns.reshape(parameters, -1).T)
        found = cost(candidates)
        tried.append(candidates)
        costs.append(found)
        return found

    def note_generation(intermediate_result: "OptimizeResult") -> None:
        best = min(float(found.min()) for found in costs)
        done = (len(costs) - 1) / settings.generations
        report(min(done, 1.0), f"best cost {best:.4g}")

    result = differential_evolution(
        cast(Any, vectorised),  # the stubs know no vectorized=True
        Bounds(np.zeros(parameters), np.ones(parameters)),
        maxiter=settings.generations,
        popsize=settings.population,
        tol=ALIKE,
        atol=NOTHING,
        rng=np.random.default_rng(settings.seed),
        callback=note_generation,
        polish=False,
        init="latinhypercube",
        updating="deferred",
        vectorized=True,
    )
    all_tried, all_costs = np.concatenate(tried), np.concatenate(costs)
    best = int(all_costs.argmin())
    return Found(
        all_tried[best],
        float(all_costs[best]),
        all_tried,
        all_costs,
        int(result.nit),
        bool(result.success),
    )
