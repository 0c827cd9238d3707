"""Distributions beside scipy's, and designs by what they promise."""

import numpy as np
import pytest
from scipy import stats

from jointplay.records.sensitivity import DESIGNS as READ
from jointplay.solver.designs import DESIGNS
from jointplay.solver.distributions import DISTRIBUTIONS
from jointplay.solver.distributions.standard_normal import quantiles, share_below

SHARES = np.concatenate([np.geomspace(2.0**-31, 0.5, 400), 1.0 - np.geomspace(2.0**-31, 0.4, 400)])
KNOWN = {
    "uniform": [({"low": 1.0, "high": 3.0}, stats.uniform(1, 2))],
    "normal": [({"mean": 10.0, "standard_deviation": 2.0}, stats.norm(10, 2))],
    "truncated-normal": [
        (
            {"mean": 10.0, "standard_deviation": 2.0, "low": 8.0, "high": 16.0},
            stats.truncnorm(-1, 3, 10, 2),
        ),
        (
            {"mean": 10.0, "standard_deviation": 2.0, "low": 22.0, "high": 28.0},
            stats.truncnorm(6, 9, 10, 2),
        ),
    ],
    "triangular": [
        ({"low": 1.0, "mode": 2.0, "high": 5.0}, stats.triang(0.25, 1, 4)),
        ({"low": 1.0, "mode": 1.0, "high": 5.0}, stats.triang(0.0, 1, 4)),
    ],
    "log-uniform": [({"low": 1e-4, "high": 0.1}, stats.loguniform(1e-4, 0.1))],
    "log-normal": [({"median": 3.0, "standard_deviation": 0.5}, stats.lognorm(0.5, scale=3))],
}


@pytest.mark.parametrize("name", DISTRIBUTIONS)
def test_quantiles_are_scipys(name):
    for fields, known in KNOWN[name]:
        one = DISTRIBUTIONS[name](distribution=name, **fields)
        assert list(one.problems()) == []
        assert one.quantiles(SHARES) == pytest.approx(known.ppf(SHARES), rel=1e-13)
        if one.ends():
            assert [getattr(one, end) for end in one.ends()] == pytest.approx(known.support())


def test_the_standard_normal_is_known_far_out():
    shares = np.concatenate([np.geomspace(1e-290, 0.49, 2001), 1.0 - np.geomspace(1e-15, 0.49, 99)])
    assert quantiles(shares) == pytest.approx(stats.norm.ppf(shares), rel=2e-15)
    for value in (-37.0, -8.0, -1.0, 0.0, 2.0, 5.0):
        assert share_below(value) == pytest.approx(stats.norm.cdf(value), rel=1e-12)


@pytest.mark.parametrize("name", DESIGNS)
def test_rows_are_as_wide_as_their_reader_takes_them_and_follow_the_seed(name):
    rows = DESIGNS[name](16, 3, 5)
    assert rows.shape == (16, READ[name].width(3), 3)
    assert rows.min() > 0.0
    assert rows.max() < 1.0
    assert np.array_equal(rows, DESIGNS[name](16, 3, 5))
    assert not np.array_equal(rows, DESIGNS[name](16, 3, 6))


@pytest.mark.parametrize(("rows", "parameters"), [(64, 6), (256, 8), (32, 10), (64, 16), (128, 16)])
def test_no_parameter_of_saltelli_has_numbers_in_a_that_depend_on_those_in_b(rows, parameters):
    """Its total index, of an output that is the parameter itself, is 1: half the mean square of the
    differences over the variance 1/12. Independent numbers have it within 1.18 / sqrt(rows)."""
    errors = []
    for seed in range(8):
        design = DESIGNS["saltelli"](rows, parameters, seed)
        errors.append(6.0 * ((design[:, 0] - design[:, 1]) ** 2).mean(axis=0) - 1.0)
    worst = np.sqrt(np.square(errors).mean(axis=0)).max()
    assert worst < 1.183 / np.sqrt(rows)


def test_a_row_of_saltelli_mixes_its_two_points():
    a, b, *mixed = np.moveaxis(DESIGNS["saltelli"](8, 3, 1), 1, 0)
    for parameter, one in enumerate(mixed):
        others = np.arange(3) != parameter
        assert np.array_equal(one[:, parameter], b[:, parameter])
        assert np.array_equal(one[:, others], a[:, others])


def test_a_row_of_morris_moves_every_parameter_once():
    moved = np.diff(DESIGNS["morris"](50, 4, 1), axis=1)
    assert ((moved != 0.0).sum(axis=1) == 1).all()
    assert ((moved != 0.0).sum(axis=2) == 1).all()
    assert set(np.abs(moved[moved != 0.0])) == {0.5}


def test_a_latin_hypercube_has_one_point_in_every_interval():
    points = DESIGNS["latin-hypercube"](50, 3, 1)[:, 0]
    for column in points.T:
        assert sorted(np.floor(50 * column)) == list(range(50))
