"""The whole of a calibration: search, spread, and a close look at the best."""

import numpy as np

from jointplay.solver.calibration.document import CHAINS
from jointplay.solver.calibration.measure import Measure
from jointplay.solver.calibration.outcome import Outcome
from jointplay.solver.calibration.problem import Calibration
from jointplay.solver.calibration.search import Cost, Found, Report, search
from jointplay.solver.calibration.spread import EquallyGood, spread

NEIGHBOURS, NEAR = 16, 1e-4
"""Candidates around the best, and how far they are, in ranges of the parameters."""
COARSER = 1.01
"""Times the cost that rounding the best may make of it."""


class NothingFits(Exception):
    """No candidate of the search could be computed."""


def calibrate(calibration: Calibration, cost: Cost, every: Measure, report: Report) -> Outcome:
    """Find the parameters that fit, and the spread of what fits equally well.

    Parameters
    ----------
    cost
        Of candidates, as `costs_of` gives it.
    every
        Measures all targets.
    report
        Called with the fraction that is done, and a few words.

    Raises
    ------
    NothingFits
        Every run of the search failed.
    """
    settings, count = calibration.search, len(calibration.space.names)
    bred = settings.generations * settings.population * count
    share = bred / (bred + CHAINS * calibration.spread.generations)

    found = search(cost, count, settings, lambda done, note: report(share * done, note))
    if not np.isfinite(found.cost):
        raise NothingFits(
            "No candidate could be computed: every run failed. Narrow the bounds of the"
            " parameters, or ask for a larger tolerance."
        )
    good = spread(
        cost,
        found,
        lambda best: equally_good(calibration, best),
        calibration.spread.generations,
        calibration.seed,
        lambda done, note: report(share + (1.0 - share) * done, note),
    )
    return _outcome(calibration, found, good, every)


def costs_of(calibration: Calibration, fitted: Measure) -> Cost:
    """Return the costs of candidates whose fitted targets are measured so."""
    return lambda unit: calibration.goals.costs(fitted(calibration.space.values(unit)))


def equally_good(calibration: Calibration, best: float) -> float:
    """Return the highest cost that is as good as the best: a factor of it, or the tolerances."""
    return max(calibration.spread.factor * best, 1.0)


def _outcome(calibration: Calibration, found: Found, good: EquallyGood, every: Measure) -> Outcome:
    space, goals = calibration.space, calibration.goals
    unit = good.best
    generator = np.random.default_rng([calibration.seed, 2])
    chosen = np.sort(generator.choice(len(good.members), min(CHAINS, len(good.members)), False))
    around = unit + NEAR * generator.uniform(-1.0, 1.0, (NEIGHBOURS, len(unit)))
    exact = space.values(unit)
    members = space.values(good.members[chosen])
    values = every(np.concatenate([[exact, space.rounded(exact)], space.values(around), members]))
    costs = goals.costs(values)
    row = 1 if costs[1] <= COARSER * costs[0] else 0
    near = values[2 : 2 + NEIGHBOURS]
    far = np.concatenate([values[row : row + 1], values[2 + NEIGHBOURS :]])
    return Outcome(
        calibration,
        found,
        good,
        space.rounded(exact) if row else exact,
        float(costs[row]),
        values[row],
        far.min(axis=0),
        far.max(axis=0),
        (near.max(axis=0) - near.min(axis=0)) / goals.tolerance,
        members,
    )
