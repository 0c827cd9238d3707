"""Promises of every statistic of channels, and the definition of each of them."""

import math
from collections.abc import Callable

import numpy as np
import pytest

from jointplay.solver.statistics import OF_CHANNELS, Grid
from jointplay.solver.statistics.quantile import MOST_KEPT, stride

PER_PERIOD = 256
REFERENCES: dict[str, Callable[[np.ndarray], np.ndarray]] = {
    "mean": lambda x: x.mean(axis=0),
    "root_mean_square": lambda x: np.sqrt((x * x).mean(axis=0)),
    "standard_deviation": lambda x: x.std(axis=0),
    "mean_absolute": lambda x: np.abs(x).mean(axis=0),
    "quantile_05": lambda x: np.quantile(x, 0.05, axis=0),
    "median": lambda x: np.quantile(x, 0.5, axis=0),
    "quantile_95": lambda x: np.quantile(x, 0.95, axis=0),
}
every_statistic = pytest.mark.parametrize("name", OF_CHANNELS)


def signals(samples: int) -> np.ndarray:
    """(samples, 4): noise, noise about a large mean, spikes at rest, a constant."""
    random = np.random.default_rng(samples)
    noise = random.normal(size=samples)
    spikes = np.where(random.random(samples) < 0.05, random.exponential(1e4, samples), 0.0)
    return np.stack([noise, 1e6 + noise, spikes, np.full(samples, -0.1)], axis=1)


def evaluated(name: str, values: np.ndarray, ends: list[int]) -> np.ndarray:
    """Return a statistic of values that come up to each of the ends, one after the other."""
    statistic, grid = OF_CHANNELS[name], Grid(len(values), PER_PERIOD)
    tally = statistic.begin(grid, values.shape[1])
    before = 0
    for end in ends:
        statistic.add(tally, values[before:end], before, grid)
        before = end
    return statistic.value(tally, before)


@every_statistic
def test_it_is_what_numpy_makes_of_the_samples(name: str) -> None:
    values = signals(1500)
    found = evaluated(name, values, [1500])
    # sums of 1500 terms round by 1e-13 of their size, and a deviation is known as its square is,
    # against the magnitudes of the differences
    assert np.all(np.abs(found - REFERENCES[name](values)) <= 1e-12 * np.abs(values).max(axis=0))


@every_statistic
@pytest.mark.parametrize("samples", [2, 1500, 5000])
def test_its_bits_do_not_depend_on_how_the_samples_come(name: str, samples: int) -> None:
    values = signals(samples)
    random = np.random.default_rng(7)
    whole = evaluated(name, values, [samples])
    for parts in (1, 3, 40, samples - 1):
        inner = random.choice(np.arange(1, samples), min(parts, samples - 1), replace=False)
        ends = [*sorted(inner.tolist()), samples]
        assert evaluated(name, values, ends).tobytes() == whole.tobytes()


@every_statistic
def test_it_scales_with_its_channel(name: str) -> None:
    values = signals(600)
    # a power of two changes no rounding
    scaled = evaluated(name, 1024.0 * values, [600])
    assert scaled.tolist() == (1024.0 * evaluated(name, values, [600])).tolist()


@every_statistic
def test_its_tally_does_not_grow_with_the_time(name: str) -> None:
    statistic = OF_CHANNELS[name]
    sizes = [len(statistic.begin(Grid(10**n, PER_PERIOD), 1)) for n in (4, 7, 10)]
    assert max(sizes) <= MOST_KEPT


@pytest.mark.parametrize("per_period", [16, 250, 256, 4096])
@pytest.mark.parametrize("periods", [20, 999, 100_000])
def test_quantiles_of_a_periodic_motion_see_all_its_phases(per_period: int, periods: int) -> None:
    grid = Grid(per_period * periods, per_period)
    kept = np.arange(0, grid.samples, stride(grid, grid.samples))
    phases = np.unique(kept % per_period)
    assert len(phases) == min(per_period, len(kept))
    assert math.isclose(len(kept), min(MOST_KEPT, grid.samples), rel_tol=0.5)


@pytest.mark.parametrize("per_period", [16, 250, 2310])
@pytest.mark.parametrize("samples", [2, MOST_KEPT, MOST_KEPT + 1, 100_000])
def test_quantiles_of_a_run_that_ends_early_are_of_all_its_time(
    per_period: int, samples: int
) -> None:
    """Values that grow evenly have the quantile that is its level, however they come."""
    values = np.linspace(0.0, 1.0, samples)[:, None]
    grid = Grid(10**9, per_period, open_ended=True)
    pieces = np.split(values, np.sort(np.random.default_rng(1).integers(0, samples, 20)))
    # one of up to 13 samples is kept where there is no more room, the last ones may be left out
    error = 1e-12 if samples <= MOST_KEPT else 13.0 / MOST_KEPT
    for name, level in (("quantile_05", 0.05), ("median", 0.5), ("quantile_95", 0.95)):
        statistic, before = OF_CHANNELS[name], 0
        tally = statistic.begin(grid, 1)
        for piece in filter(len, pieces):
            statistic.add(tally, piece, before, grid)
            before += len(piece)
        assert math.isclose(statistic.value(tally, before)[0], level, abs_tol=error)
