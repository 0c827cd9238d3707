"""Exponents of periodic orbits of several periods, whose growth differs from period to period."""

import numpy as np
import pytest

from jointplay.solver.runs.study.indicators import Sections, exponents, indicators_of

PERIOD, EXPONENT, NOISE = 2.0, -0.35, 1e-6


def growth(turns: int, periods: int = 120) -> np.ndarray:
    """Growth that is the same in every orbit of so many periods, but for noise."""
    random = np.random.default_rng(3)
    orbit = random.normal(size=turns)
    orbit += PERIOD * EXPONENT - orbit.mean()
    return np.tile(orbit, periods)[:periods] + NOISE * random.normal(size=periods)


@pytest.mark.parametrize("turns", [2, 3, 5, 7])
def test_growth_along_an_orbit_is_no_error(turns: int) -> None:
    found, finer = exponents(growth(turns), growth(turns)[:8], PERIOD, 50, turns)
    assert found.value == pytest.approx(EXPONENT, abs=NOISE)
    assert found.error < NOISE
    assert finer.value == pytest.approx(EXPONENT, abs=3 * NOISE)
    assert finer.error < 3 * NOISE


def test_a_record_of_few_orbits_is_taken_by_periods() -> None:
    short, finer = growth(20), growth(20)[:8]
    assert exponents(short, finer, PERIOD, 50, 20) == exponents(short, finer, PERIOD, 50)
    assert (
        exponents(growth(9), finer, PERIOD, 50, 9)[1] == exponents(growth(9), finer, PERIOD, 50)[1]
    )


@pytest.mark.parametrize(("sections", "is_told"), [(120, True), (119, False)])
def test_sections_that_are_no_periods_are_no_measure_of_an_orbit(
    sections: int, is_told: bool
) -> None:
    states = np.tile([[0.0], [0.3], [-0.5]], (40, 1))[:sections]
    grown = growth(3)
    found, _ = indicators_of(
        ["lyapunov", "recurrence"],
        Sections(states, np.ones(1), np.zeros(1, bool), 1, 1.0),
        grown,
        grown[:0],
        PERIOD,
        0,
    )
    assert found["period"] == 3.0
    assert (found["lyapunov_error"] < NOISE) == is_told
