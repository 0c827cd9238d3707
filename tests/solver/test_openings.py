"""Where a cubic falls to zero: when a gap opens."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from solver.lanes.contacts import falling_root

depths = st.floats(1e-12, 1.0)
rates = st.floats(-10.0, 10.0)


@given(start=depths, end=st.floats(-1.0, 0.0), start_rate=rates, end_rate=rates)
def test_the_cubic_changes_its_sign_at_the_root(
    start: float, end: float, start_rate: float, end_rate: float
) -> None:
    def cubic(x: float) -> float:
        rest = 1.0 - x
        left = (1.0 + 2.0 * x) * start + x * start_rate
        right = (3.0 - 2.0 * x) * end - rest * end_rate
        return rest * rest * left + x * x * right

    root = falling_root(start, start_rate, end, end_rate)
    assert 0.0 <= root <= 1.0
    # at a double root Newton's steps only halve: forty of them come to 1e-12 of the interval
    size = max(start, -end, abs(start_rate), abs(end_rate))
    assert cubic(root) == pytest.approx(0.0, abs=1e-11 * size)


@given(start=depths, speed=st.floats(1.0, 1e3))
def test_a_straight_line_is_met_at_once(start: float, speed: float) -> None:
    rate = -start * speed
    end = start + rate
    assert falling_root(start, rate, min(end, 0.0), rate) == pytest.approx(1.0 / speed, rel=1e-12)
