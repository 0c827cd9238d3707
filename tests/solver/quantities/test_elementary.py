"""Sine, cosine, logarithm, exponential and power of our own, against the C library."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from jointplay.solver.quantities import elementary as lane
from jointplay.solver.quantities import scalars

ULP_OF_ONE = 2.0**-52

signed = st.sampled_from([-1.0, 1.0])


@given(st.floats(-1e6, 1e6))
def test_sine_and_cosine_are_within_two_units_in_the_last_place_of_one(x: float) -> None:
    sine, cosine = lane.sine_cosine(x)
    assert abs(sine - math.sin(x)) <= 2 * ULP_OF_ONE
    assert abs(cosine - math.cos(x)) <= 2 * ULP_OF_ONE


@given(st.integers(-600_000, 600_000), st.floats(-1e-6, 1e-6))
def test_sine_and_cosine_stay_sharp_around_multiples_of_a_quarter_turn(n: int, by: float) -> None:
    x = n * (math.pi / 2.0) + by
    sine, cosine = lane.sine_cosine(x)
    assert abs(sine - math.sin(x)) <= 2 * ULP_OF_ONE
    assert abs(cosine - math.cos(x)) <= 2 * ULP_OF_ONE


def test_sine_of_nothing_is_nothing_and_small_angles_are_kept_whole() -> None:
    assert lane.sine_cosine(0.0) == (0.0, 1.0)
    for x in (1e-300, 1e-20, 1e-9):
        assert lane.sine_cosine(x) == (x, 1.0)
        assert lane.sine_cosine(-x) == (-x, 1.0)


@given(st.floats(min_value=1e-300, max_value=1e300))
def test_log2_is_within_its_stated_bound(x: float) -> None:
    exact = math.log2(x)
    assert abs(lane.log2(x) - exact) <= 4e-16 * max(1.0, abs(exact))


def test_log2_of_powers_of_two_is_exact() -> None:
    for n in range(-1000, 1001):
        assert lane.log2(math.ldexp(1.0, n)) == n


@given(st.floats(-1000.0, 1000.0))
def test_exp2_is_within_its_stated_bound(x: float) -> None:
    assert lane.exp2(x) == pytest.approx(math.exp2(x), rel=4e-16)


@given(st.floats(min_value=1e-300, max_value=1e300))
def test_log_is_within_its_stated_bound(x: float) -> None:
    assert abs(lane.log(x) - math.log(x)) <= 4e-16 * max(1.0, abs(math.log2(x)))


@given(st.floats(-690.0, 690.0))
def test_exp_is_within_its_stated_bound(x: float) -> None:
    assert lane.exp(x) == pytest.approx(math.exp(x), rel=2e-16 * max(2.0, abs(x)))


@given(st.floats(min_value=1e-30, max_value=1e6), st.floats(1.0, 3.0))
def test_power_is_within_its_stated_bound(x: float, exponent: float) -> None:
    bound = 1e-15 * exponent * max(1.0, abs(math.log2(x)))
    assert lane.power(x, exponent) == pytest.approx(x**exponent, rel=bound)


@given(st.floats(1.0, 3.0))
def test_power_of_zero_is_zero(exponent: float) -> None:
    assert lane.power(0.0, exponent) == 0.0


@given(st.floats(1e-9, 1e-3), st.floats(1.0, 3.0))
def test_power_grows_with_its_base(x: float, exponent: float) -> None:
    # neighbours one part in 1e12 apart: rounding of 1e-13 at most keeps their order
    assert lane.power(x, exponent) < lane.power(x * (1.0 + 1e-12), exponent)


@given(st.floats(min_value=1e-300, max_value=1e300))
def test_the_coarse_logarithm_is_within_its_stated_bound(x: float) -> None:
    assert lane.coarse_log2(x) == pytest.approx(math.log2(x), abs=1.3e-5)


@given(st.floats(-1000.0, 1000.0))
def test_the_coarse_exponential_is_within_its_stated_bound(x: float) -> None:
    assert lane.coarse_exp2(x) == pytest.approx(math.exp2(x), rel=1.2e-7)


FUNCTIONS = {
    "sine": (lambda x: scalars.sine_cosine(x)[0], math.sin, (-1e9, 1e9)),
    "cosine": (lambda x: scalars.sine_cosine(x)[1], math.cos, (-1e9, 1e9)),
    "logarithm": (scalars.logarithm, math.log, (1e-9, 1e9)),
    "exponential": (scalars.exponential, math.exp, (-30.0, 30.0)),
    "power": (lambda x: scalars.power(x, 2.3), lambda x: x**2.3, (0.0, 1e3)),
    "angle": (lambda x: scalars.direction_angle(x, 0.3 - x), None, (-2.0, 2.0)),
}


@pytest.mark.parametrize("name", FUNCTIONS)
def test_numbers_and_arrays_of_them_have_the_same_bits(name: str) -> None:
    function, known, (low, high) = FUNCTIONS[name]
    spread = np.random.default_rng(1).uniform(low, high, 500)
    x = np.concatenate([spread, [low, high], spread * 1e-9 if low < 0.0 else spread])
    found = function(x)
    assert [function(float(one)) for one in x] == found.tolist()
    if known is None:
        known = lambda x: math.atan2(0.3 - x, x)  # noqa: E731
    # of an angle of 1e9 rad, a bit is 1e-7
    bound = 1e-15 if high < 1e9 or low > 0.0 else 1e-7
    assert found == pytest.approx([known(float(one)) for one in x], rel=1e-14, abs=bound)


def test_sines_keep_what_is_no_number_and_refuse_the_infinite() -> None:
    assert all(map(math.isnan, scalars.sine_cosine(math.nan)))
    assert np.isnan(scalars.sine_cosine(np.array([math.nan]))).all()
    with pytest.raises(ValueError, match="math domain error"):
        scalars.sine_cosine(math.inf)


def test_there_is_no_logarithm_of_nothing() -> None:
    for x in (0.0, -0.0, -1.0):
        with pytest.raises(ValueError, match="math domain error"):
            scalars.logarithm(x)
    found = scalars.logarithm(np.array([0.0, -1.0, math.nan, 1.0]))
    assert np.isnan(found[:3]).all()
    assert found[3] == 0.0
    assert math.isnan(scalars.logarithm(math.nan))


def test_the_direction_of_the_negative_axis_is_pi() -> None:
    for zero in (0.0, -0.0):
        assert scalars.direction_angle(-1.0, zero) == math.pi
        assert scalars.direction_angle(np.array([-1.0]), np.array([zero])) == math.pi
