"""The extreme of nine sampled values: between samples, where a function is smooth or bends."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from jointplay.solver.kernels.loop import extreme as nine
from jointplay.solver.kernels.loop.extreme import POINTS


def extreme(
    times: NDArray[np.float64], values: NDArray[np.float64], sense: float
) -> tuple[float, float]:
    """Return time and value of the extreme near nine samples."""
    table = np.zeros(nine.SIZE)
    table[nine.TIMES : nine.TIMES + POINTS] = times
    table[nine.VALUES : nine.VALUES + POINTS] = values
    nine.compare_times(table)
    nine.compare_values(table)
    time, value, *_ = nine.extreme(table, sense)
    return time, value


SENSES = pytest.mark.parametrize("sense", [1.0, -1.0])


@SENSES
@given(top=st.floats(0.3, 0.7), width=st.floats(1.5, 10.0))
def test_a_smooth_extreme_is_found_between_the_samples(
    sense: float, top: float, width: float
) -> None:
    times = np.linspace(0.0, 1.0, POINTS)
    values = sense * (1.0 - np.cosh((times - top) / width))
    time, value = extreme(times, values, sense)
    # a parabola's vertex errs by the fourth derivative: less than (step / width)^2 of the step
    assert time == pytest.approx(top, abs=1.0 / 8.0 * (1.0 / 8.0 / width) ** 2)
    assert value == pytest.approx(0.0, abs=1e-6)


@SENSES
@given(
    top=st.floats(0.27, 0.73),
    rise=st.floats(0.5, 5.0),
    fall=st.floats(0.5, 5.0),
    bends=st.tuples(st.floats(-0.5, 0.5), st.floats(-0.5, 0.5)),
)
def test_a_kink_is_found_between_the_samples(
    sense: float, top: float, rise: float, fall: float, bends: tuple[float, float]
) -> None:
    # both pieces are parabolas, which the continuation follows exactly; what errs is the instant,
    # by linear interpolation of their difference over an eighth: at most
    # 1 / 8^2 / 8 * 2 * |bend - bend'| / (rise + fall) < 4e-3, and the value by the slope times that
    times = np.linspace(0.0, 1.0, POINTS)
    late = times - top
    before = rise * late + bends[0] * late**2
    after = -fall * late + bends[1] * late**2
    values = sense * np.where(late < 0.0, before, after)
    time, value = extreme(times, values, sense)
    nearest = float((sense * values).max())
    assert nearest <= sense * value <= 1e-12
    assert time == pytest.approx(top, abs=8e-3)
    assert sense * value == pytest.approx(0.0, abs=8e-3 * max(rise, fall))


@SENSES
def test_a_jump_has_no_value_beyond_its_samples(sense: float) -> None:
    times = np.linspace(0.0, 1.0, POINTS)
    values = sense * np.where(times < 0.5, 0.0, 1.0)
    _, value = extreme(times, values, sense)
    assert value == sense


@SENSES
def test_a_function_that_rests_at_its_extreme_stays_there(sense: float) -> None:
    # a contact force that falls to zero: no polynomial through it may go below
    times = np.linspace(0.0, 1.0, POINTS)
    values = -sense * np.maximum(0.55 - times, 0.0) ** 1.5
    _, value = extreme(times, values, sense)
    assert value == 0.0
