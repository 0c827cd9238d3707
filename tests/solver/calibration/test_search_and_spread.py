"""Search and spread on costs whose valleys are known, without any mechanism."""

import numpy as np
import pytest

from jointplay.solver.calibration.document import Search
from jointplay.solver.calibration.search import search
from jointplay.solver.calibration.spread import EquallyGood, Limit, spread

CENTRE = np.array([0.4, 0.6])
TURN = np.array([[np.cos(0.7), np.sin(0.7)], [-np.sin(0.7), np.cos(0.7)]])
WIDTHS = np.array([0.2, 0.01])
"""Half axes of the ellipse {cost <= 1}: a narrow valley across both coordinates."""


def ellipse(unit: np.ndarray) -> np.ndarray:
    return np.linalg.norm((unit - CENTRE) @ TURN.T / WIDTHS, axis=1)


def equally_good(best: float) -> float:
    return max(1.0, 1.2 * best)


def limited(cost: float) -> Limit:
    """Return a limit that does not follow the best."""
    return lambda _best: cost


def quiet(done: float, note: str) -> None:
    assert 0.0 <= done <= 1.0


def test_the_search_finds_the_bottom_of_a_narrow_valley_and_counts_what_it_tried():
    found = search(ellipse, 2, Search(population=15, generations=80, seed=3), quiet)
    np.testing.assert_allclose(found.best, CENTRE, rtol=0, atol=1e-2)
    assert found.cost == ellipse(found.best[None, :])[0] == found.costs.min()
    assert len(found.tried) == 30 * (found.generations + 1)
    np.testing.assert_array_equal(found.costs, ellipse(found.tried))
    best = found.best_costs()
    assert (len(best), best[-1]) == (found.generations + 1, found.cost)
    assert best[0] == found.costs[:30].min() > best[10] > best[-1]
    assert (np.diff(best) <= 0.0).all()


def test_what_fits_equally_well_is_spread_evenly_over_the_whole_valley():
    found = search(ellipse, 2, Search(seed=3), quiet)
    good = spread(ellipse, found, limited(1.0), 200, 3, quiet)
    assert good.costs.max() <= 1.0
    inside = (good.members - CENTRE) @ TURN.T / WIDTHS
    radius = np.linalg.norm(inside, axis=1)
    # evenly over an ellipse the squared radius is evenly distributed over 0..1, and each axis has
    # the standard deviation 1/2; some 200 independent points among 64 * 150 that are correlated
    np.testing.assert_allclose(
        np.quantile(radius**2, [0.25, 0.5, 0.75]), [0.25, 0.5, 0.75], atol=0.1
    )
    np.testing.assert_allclose(inside.std(axis=0), 0.5, rtol=0.15)
    np.testing.assert_allclose(inside.mean(axis=0), 0.0, atol=0.1)
    assert good.settled


@pytest.mark.parametrize("seed", [0, 1, 3])
def test_a_long_bent_valley_is_seen_over_its_whole_length_and_said_to_be_unsettled(seed):
    """A hundredth wide along a parabola: what fits has its first coordinate even over 0..1."""

    def valley(unit: np.ndarray) -> np.ndarray:
        return abs(unit[:, 1] - unit[:, 0] ** 2) / 0.01

    found = search(valley, 2, Search(seed=seed), quiet)
    good = spread(valley, found, limited(1.0), 60, seed, quiet)
    shares = [0.05, 0.5, 0.95]
    np.testing.assert_allclose(np.quantile(good.members[:, 0], shares), shares, atol=0.2)
    assert not good.settled


@pytest.mark.parametrize("generations", [2, 3, 30])
def test_a_limit_that_the_chains_do_not_come_down_to_is_reached_from_the_search(generations):
    """Six parameters within a thousandth each: 1e-18 of the box."""

    def needle(unit: np.ndarray) -> np.ndarray:
        return abs(unit - 0.3).max(axis=1) / 1e-3

    found = search(needle, 6, Search(generations=200), quiet)
    good = spread(needle, found, limited(1.0), generations, 0, quiet)
    assert good.costs.max() <= 1.0
    assert len(good.members) > 0
    assert not good.settled


def test_a_spread_ends_at_the_bounds():
    found = search(lambda unit: unit[:, 0], 1, Search(), quiet)
    good = spread(lambda unit: unit[:, 0], found, limited(0.3), 100, 0, quiet)
    assert good.members.min() >= 0.0
    np.testing.assert_allclose(good.members.max(), 0.3, atol=0.02)  # 64 chains fill 0..0.3


def test_islands_are_both_found_if_the_search_came_across_both():
    def islands(unit: np.ndarray) -> np.ndarray:
        return np.minimum(abs(unit[:, 0] - 0.2), abs(unit[:, 0] - 0.8))

    found = search(islands, 1, Search(population=40), quiet)
    good = spread(islands, found, limited(0.05), 60, 0, quiet)
    share = (good.members[:, 0] < 0.5).mean()
    assert 0.1 < share < 0.9


WIDTH = 0.002


def bowl(unit: np.ndarray) -> np.ndarray:
    """Cost whose sets {cost <= c} are balls of the radius c WIDTH sqrt(parameters)."""
    return np.sqrt((((unit - 0.37) / WIDTH) ** 2).mean(axis=1))


def after_a_short_search(parameters: int, seed: int) -> tuple[EquallyGood, float, np.ndarray]:
    """Return a spread, the lowest cost of the search before, and the share that members reach of
    the width of what is equally good, (parameters,)."""
    found = search(bowl, parameters, Search(generations=1, seed=seed), quiet)
    good = spread(bowl, found, equally_good, 60, seed, quiet)
    width = 2.0 * good.limit * WIDTH * np.sqrt(parameters)
    return good, found.cost, np.ptp(good.members, axis=0) / width


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("parameters", [2, 4])
def test_the_limit_follows_what_chains_find_and_the_spread_what_is_left(parameters, seed):
    good, cost, reached = after_a_short_search(parameters, seed)
    assert cost > 2.0 > 1.0 > good.cost  # of the search, and of the chains
    assert good.limit == equally_good(good.cost)
    assert (bowl(good.best[None])[0], bowl(good.members).max() <= good.limit) == (good.cost, True)
    # of 64 points evenly in a ball of four dimensions the range is 0.7 of its width and more
    assert (reached > 0.7).all()
    assert good.settled == (parameters == 2)


def test_a_spread_whose_last_steps_find_something_better_has_not_settled():
    """A hole that is never tried before: in the last of the generations a chain falls into it."""
    calls = []

    def with_a_hole(unit: np.ndarray) -> np.ndarray:
        calls.append(len(unit))
        costs = 2.0 + unit[:, 0] / 10.0
        if len(calls) == 2 * 60:
            costs[0] = 0.1
        return costs

    found = search(lambda unit: 2.0 + unit[:, 0] / 10.0, 1, Search(generations=3), quiet)
    good = spread(with_a_hole, found, equally_good, 60, 0, quiet)
    assert (good.cost, good.limit, len(good.members)) == (0.1, 1.0, 1)
    assert not good.settled


@pytest.mark.parametrize("seed", [0, 7])
def test_the_seed_alone_decides(seed):
    runs = []
    for _ in range(2):
        found = search(ellipse, 2, Search(population=5, generations=6, seed=seed), quiet)
        good = spread(ellipse, found, equally_good, 4, seed, quiet)
        runs.append((found.tried, good.members))
    np.testing.assert_array_equal(runs[0][0], runs[1][0])
    np.testing.assert_array_equal(runs[0][1], runs[1][1])
    other = search(ellipse, 2, Search(population=5, generations=6, seed=seed + 1), quiet)
    assert not np.array_equal(other.tried[:10], runs[0][0][:10])


def test_candidates_that_fail_are_avoided():
    def half_fails(unit: np.ndarray) -> np.ndarray:
        return np.where(unit[:, 0] < 0.5, np.inf, abs(unit[:, 0] - 0.4))

    found = search(half_fails, 1, Search(population=10, generations=30), quiet)
    assert found.cost == pytest.approx(0.1, abs=1e-3)  # at the edge of what can be computed
    assert np.isinf(found.costs).any()
