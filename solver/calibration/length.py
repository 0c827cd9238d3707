"""The most runs that a calibration has: of the search, of the spread, and of the last look."""

from collections.abc import Sequence

from jointplay.solver.calibration.calibrate import NEIGHBOURS
from jointplay.solver.calibration.document import CHAINS, CalibrationTarget, Search, Spread


def most_candidates(search: Search, spread: Spread, parameters: int) -> int:
    """Return how many candidates the longest search and spread of so many parameters have."""
    bred = search.population * parameters * (search.generations + 1)
    return bred + CHAINS * spread.generations


def most_runs(candidates: int, cases: Sequence[Sequence[CalibrationTarget]]) -> list[int]:
    """Return the runs in each case, of which the targets are given.

    Candidates run where a target has a weight; the best at last, and some beside it, in every case.
    """
    last = 2 + NEIGHBOURS + CHAINS
    return [
        last + (candidates if any(target.weight > 0.0 for target in case) else 0) for case in cases
    ]
