"""Time as whole periods plus local time: the last period is as sharp as the first."""

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from jointplay.solver.kernels.loop.periods import product_difference
from tests.solver.completed_runs import run

times = st.floats(1e-9, 1e9)


@given(st.integers(0, 10**9).map(float), times, st.integers(0, 10**9).map(float), times)
def test_differences_of_products_are_exact_to_one_rounding(
    a: float, b: float, c: float, d: float
) -> None:
    exact = Fraction(a) * Fraction(b) - Fraction(c) * Fraction(d)
    found = Fraction(product_difference(a, b, c, d))
    # one rounding of the result; the two products' own roundings, 2^-53 of each, are rounded once
    # more when they are added
    slack = Fraction(2) ** -52 * abs(exact) + Fraction(2) ** -104 * (
        abs(Fraction(a) * Fraction(b)) + abs(Fraction(c) * Fraction(d))
    )
    assert abs(found - exact) <= slack


@given(st.integers(1, 10**8), st.integers(1, 1000), st.integers(0, 1000))
def test_the_local_time_of_a_late_sample_keeps_its_last_digit(
    periods: int, per_period: int, within: int
) -> None:
    period = 2.0 * math.pi / 3.3
    step = period / per_period
    index = periods * per_period + within
    exact = Fraction(index) * Fraction(step) - Fraction(periods) * Fraction(period)
    found = product_difference(float(index), step, float(periods), period)
    assert abs(Fraction(found) - exact) <= Fraction(2) ** -52 * abs(exact) + Fraction(1, 10**20)


def test_sections_of_a_late_period_are_where_the_first_ones_were() -> None:
    # the ideal slider-crank repeats exactly, so section 10 000 must show the start again
    period = 2.0 * math.pi / 500.0
    late = run(
        "slider-crank",
        10_000 * period,
        parameters={"clearance": 0.0, "speed": 500.0},
        output_step=100 * period,
        channels=["slider.x", "slider.vx", "slider.ax"],
    )
    assert len(late.section_time) == 10_001
    # with time kept as one float, 126 s * 2e-16 * 500 rad/s would turn the crank by 1e-11
    for name, scale in (("slider.x", 0.17), ("slider.vx", 25.0), ("slider.ax", 2e4)):
        spread = np.ptp(late.sections[name])
        assert spread <= 1e-14 * scale, name


@pytest.mark.parametrize("periods", [1, 20, pytest.param(500, marks=pytest.mark.long)])
def test_a_driven_angle_is_as_sharp_after_many_periods(periods: int) -> None:
    speed = 7.0
    period = 2.0 * math.pi / speed
    duration = (periods + 0.25) * period
    found = run(
        "seven-bar-press",
        duration,
        parameters={"speed": speed, "friction": 0.1, "gravity_x": 0.0, "restitution": 0.5},
        tolerance=1e-5,
        output_step=duration,
        channels=["crank1.y", "crank1.theta"],
    )
    length = 0.0805445
    # a quarter turn past whole turns: the crank stands upright to the rounding of the local time
    assert found["crank1.y"][-1] == pytest.approx(length, abs=1e-15)
    # cos is flat there; the angle shows the local time itself
    assert found["crank1.theta"][-1] == pytest.approx(
        (periods + 0.25) * 2.0 * math.pi, rel=4e-16 * 4
    )
