"""The 0-1 test on series that are regular or chaotic beyond doubt."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from jointplay.solver.nonlinear import fourier
from jointplay.solver.nonlinear.zero_one import FREQUENCIES, zero_one_test
from tests.solver.nonlinear.exponents import agrees
from tests.solver.nonlinear.textbook import (
    CAT,
    HENON,
    LOGISTIC_4,
    UEDA,
    circle,
    delayed_logistic,
    logistic,
    ueda_section,
)

GOLDEN = 0.5 * (math.sqrt(5.0) - 1.0)


def as_published(series: np.ndarray, c: float) -> float:
    """K_c of one frequency, the formulas of Gottwald and Melbourne one by one, V_osc and all."""
    count = len(series)
    reach = count // 10
    p = [0.0]
    q = [0.0]
    for j in range(1, count + 1):
        p.append(p[-1] + series[j - 1] * math.cos(j * c))
        q.append(q[-1] + series[j - 1] * math.sin(j * c))
    mean = sum(series) / count
    modified = []
    for n in range(1, reach + 1):
        starts = range(1, count - reach + 1)
        square = sum((p[j + n] - p[j]) ** 2 + (q[j + n] - q[j]) ** 2 for j in starts)
        oscillating = mean**2 * (1.0 - math.cos(n * c)) / (1.0 - math.cos(c))
        modified.append(square / len(starts) - oscillating)
    return float(np.corrcoef(np.arange(1, reach + 1), modified)[0, 1])


@pytest.mark.parametrize(
    "series",
    [
        LOGISTIC_4.orbit(400)[:, 0],
        logistic(3.5).orbit(400, 200)[:, 0],
        np.cos(2.0 * math.pi * GOLDEN * np.arange(400.0)),
    ],
    ids=["chaotic", "period 4", "quasi-periodic"],
)
def test_it_is_the_published_formula(series: np.ndarray) -> None:
    drawn = np.random.default_rng(7).random(FREQUENCIES)
    frequencies = math.pi / 5.0 + 3.0 * math.pi / 5.0 * drawn
    centred = series - series.mean()
    expected = np.median([as_published(centred, float(c)) for c in frequencies])
    found = zero_one_test(series, seed=7)
    # Fourier transforms round to 1e-16 of the sum of squares, which exceeds what is left of it
    # after the cancellation by less than the number of samples squared
    assert found.value == pytest.approx(expected, abs=1e-9)


def test_transforms_are_no_longer_than_displacements_need(monkeypatch: pytest.MonkeyPatch) -> None:
    """Displacements go up to 500 of 5000 samples: a transform of them all would have 8192."""
    found: list[tuple[int, int]] = []
    original = fourier._by_halves

    def counted(z: fourier.Complex) -> fourier.Complex:
        found.append(z[0].shape)
        return original(z)

    monkeypatch.setattr(fourier, "_by_halves", counted)
    zero_one_test(LOGISTIC_4.orbit(5000))
    assert {size for size, _ in found} == {2048}
    # three blocks of starts and one way back for each frequency, and the series itself
    assert sum(columns for _, columns in found) == 4 * FREQUENCIES + 3


def test_a_mean_that_is_kept_would_be_taken_out_by_the_oscillating_term() -> None:
    """The published form corrects for a mean that is not zero, which we do beforehand."""
    series = LOGISTIC_4.orbit(600)[:, 0]
    drawn = np.random.default_rng(0).random(FREQUENCIES)[:10]
    frequencies = math.pi / 5.0 + 3.0 * math.pi / 5.0 * drawn
    kept = [as_published(series, float(c)) for c in frequencies]
    removed = [as_published(series - series.mean(), float(c)) for c in frequencies]
    assert kept == pytest.approx(removed, abs=0.05)  # cross terms, of the order of n_cut / N


@pytest.mark.parametrize(
    "series",
    [
        LOGISTIC_4.orbit(1000)[:, 0],
        logistic(3.9).orbit(1000, 100)[:, 0],
        HENON.orbit(1000, 100),
        CAT.orbit(1000),
        ueda_section(),
    ],
    ids=["logistic 4", "logistic 3.9", "Hénon", "cat", "Duffing"],
)
def test_chaos_has_k_near_one(series: np.ndarray) -> None:
    found = zero_one_test(series)
    assert found.value > 0.95
    assert found.error < 0.1


@pytest.mark.parametrize(
    "series",
    [
        logistic(3.2).orbit(1000, 500)[:, 0],
        logistic(3.5).orbit(1000, 500)[:, 0],
        logistic(3.83).orbit(1000, 500)[:, 0],
        np.cos(2.0 * math.pi * circle(GOLDEN, 0.9).orbit(1000)[:, 0]),
        delayed_logistic(2.1).orbit(1000, 1000),
    ],
    ids=["period 2", "period 4", "period 3", "circle", "closed curve"],
)
def test_regular_motion_has_k_near_zero(series: np.ndarray) -> None:
    found = zero_one_test(series)
    assert abs(found.value) < 0.1
    assert found.error < 0.2


def test_chaos_in_narrow_bands_is_left_open_until_the_record_is_long() -> None:
    """Just above the first band merging at r = 3.6786 … and below it, at 3.6: two bands."""
    short, long = (zero_one_test(logistic(3.6).orbit(n, 500)[:, 0]) for n in (500, 5000))
    assert 0.1 < short.value < 0.9
    assert short.error > 0.1
    assert long.value > 0.95


def test_weak_chaos_sampled_too_often_looks_regular() -> None:
    """Why there is one sample a period: oversampling hides chaos, as Gottwald and Melbourne say."""
    blocks = 60
    x, states = UEDA.start, []
    for i in range(12 * blocks):
        time = i * UEDA.block_time / blocks
        x = UEDA.flow.advance(time, x, UEDA.block_time / blocks, 2)
        states.append(x[0])
    assert zero_one_test(np.array(states)).value < 0.5
    assert zero_one_test(ueda_section()[:, 0]).value > 0.95


def test_a_constant_series_is_regular_without_a_warning() -> None:
    found = zero_one_test(np.full(500, 0.1))
    assert (found.value, found.error) == (0.0, 0.0)


def test_rounding_about_a_constant_is_no_chaos() -> None:
    noise = 1.0 + 1e-15 * np.random.default_rng(0).standard_normal(500)
    assert zero_one_test(noise).value == 0.0


def test_what_lies_below_the_resolution_is_constant() -> None:
    noise = 1.0 + 1e-8 * np.random.default_rng(0).standard_normal(500)
    assert zero_one_test(noise).value > 0.9  # the test has no scale of its own
    assert zero_one_test(noise, resolution=1e-6).value == 0.0


def test_constant_columns_do_not_count() -> None:
    chaotic = HENON.orbit(500, 100)
    with_constant = np.column_stack([np.ones(500), chaotic, np.zeros(500)])
    assert zero_one_test(with_constant) == zero_one_test(chaotic)


def test_columns_that_disagree_show_in_the_error() -> None:
    regular = logistic(3.5).orbit(1000, 500)
    mixed = np.column_stack([LOGISTIC_4.orbit(1000), regular])
    found = zero_one_test(mixed)
    assert 0.3 < found.value < 0.7
    assert found.error > 0.5


def test_short_records_say_nothing() -> None:
    assert zero_one_test(LOGISTIC_4.orbit(299)).error >= 1.0
    assert zero_one_test(LOGISTIC_4.orbit(300)).error < 0.1
    assert math.isnan(zero_one_test(LOGISTIC_4.orbit(29)).value)


def test_series_must_be_finite() -> None:
    with pytest.raises(ValueError, match="finite samples"):
        zero_one_test(np.array([0.0] * 50 + [math.nan] * 50))


@pytest.mark.parametrize("rate", [3.5, 3.6, 3.9])
def test_the_seed_matters_less_than_the_error(rate: float) -> None:
    series = logistic(rate).orbit(500, 300)[:, 0]
    found = [zero_one_test(series, seed=seed) for seed in range(5)]
    assert found[0] == zero_one_test(series, seed=0)
    for estimate in found:
        # the error is the scatter of one frequency, the median of 100 scatters ten times less
        assert agrees(estimate, found[0].value, errors=1.0)


@settings(max_examples=25)
@given(
    st.floats(-1e3, 1e3),
    st.floats(1e-6, 1e6),
    st.booleans(),
    st.sampled_from([3.5, 3.6, 3.83, 3.9, 4.0]),
)
def test_origin_unit_and_sense_do_not_matter(
    shift: float, scale: float, mirrored: bool, rate: float
) -> None:
    series = logistic(rate).orbit(300, 100)[:, 0]
    moved = (-scale if mirrored else scale) * (series + shift)
    expected, found = zero_one_test(series), zero_one_test(moved)
    # shifting by 1e3 loses three of sixteen digits of the series
    assert found.value == pytest.approx(expected.value, abs=1e-6)
    assert found.error == pytest.approx(expected.error, abs=1e-6)
