"""The extreme of five sampled values: where it is, how much, and how far off that may be."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from numpy.typing import NDArray

from jointplay.solver.kernels.loop.extremes.search.brackets import NODES
from jointplay.solver.kernels.loop.extremes.search.extreme import STEEPER, slope_left_out
from jointplay.solver.kernels.loop.extremes.search.extreme import extreme as extreme_of

SENSES = pytest.mark.parametrize("sense", [1.0, -1.0])
ABSCISSA = np.arange(float(NODES))


def extreme(values: NDArray[np.float64], sense: float) -> tuple[float, float, float]:
    """Return the abscissa of an extreme, its value, and the bound on what that is off."""
    so_far, best = -sense * np.inf, int(np.argmax(sense * values))
    abscissa, value, error, _ = extreme_of(values, best, sense, so_far, 1.0)
    return abscissa, value, error


@SENSES
@given(top=st.floats(0.5, 3.5), turn=st.floats(0.01, 1.0))
def test_a_sine_is_within_the_bound_that_is_given(sense: float, top: float, turn: float) -> None:
    # samples a sixth of a turn apart at most; rounding counts where the sine hardly bends
    abscissa, value, error = extreme(sense * np.cos(turn * (ABSCISSA - top)), sense)
    assert abs(sense * value - 1.0) <= error + 1e-15
    # the bound is of the order of the term that is left out, but for a middle that is not curved
    if abs(top - 2.0) <= 0.5 and turn <= 0.5:
        assert error <= turn**5 + 1e-15
        assert abscissa == pytest.approx(top, abs=0.1 * turn**2 + 2e-3 + 1e-7 / turn**2)


@given(top=st.floats(1.0, 3.0), turn=st.floats(0.1, 0.4))
def test_a_value_where_a_sine_seems_to_turn_tells_its_slope_there(top: float, turn: float) -> None:
    abscissa, value, _ = extreme(np.cos(turn * (ABSCISSA - top)), 1.0)
    off = abs(np.cos(turn * (abscissa - top)) - value)
    slope = abs(turn * np.sin(turn * (abscissa - top)))
    # terms beyond the fifth count a little; so does the abscissa, which is not iterated to its end
    assert slope <= 1.5 * slope_left_out(abscissa, off) + 1e-5 * turn**2


@SENSES
@given(top=st.floats(1.0, 3.0), rise=st.floats(0.5, 5.0), fall=st.floats(0.5, 5.0))
def test_a_corner_is_not_taken_for_sharp(
    sense: float, top: float, rise: float, fall: float
) -> None:
    late = ABSCISSA - top
    values = sense * np.where(late < 0.0, rise * late, -fall * late)
    _, value, error = extreme(values, sense)
    # the corner is no farther from the best sample than its neighbours are
    missing = -sense * value
    assert missing <= max(error, 1e-12)


@SENSES
@given(
    top=st.floats(1.6, 2.4),
    ratio=st.floats(0.7, 1.4),
    bends=st.tuples(st.floats(-0.9, 0.9), st.floats(-0.9, 0.9)),
    spacing=st.floats(1e-6, 1e-2),
)
def test_a_corner_is_within_the_bound_that_shrinks_with_the_nodes(
    sense: float, top: float, ratio: float, bends: tuple[float, float], spacing: float
) -> None:
    late = ABSCISSA - top
    # slopes of 1 and the ratio, which change by as much in a fourth of the step
    before = late + 0.5 * STEEPER * spacing * bends[0] * late**2
    behind = -ratio * (late + 0.5 * STEEPER * spacing * bends[1] * late**2)
    values = sense * np.where(late < 0.0, before, behind)
    assume(np.argmax(sense * values) == 2)
    _, value, error, _ = extreme_of(values, 2, sense, -sense * np.inf, spacing)
    assert -sense * value <= error + 1e-15
    # the middle node is below the corner by a slope, and what lines bend by is of the second order
    assert error <= max(1.0, ratio) * abs(top - 2.0) + 40.0 * spacing + 1e-15


@SENSES
@given(top=st.floats(3.05, 3.9), fall=st.floats(0.2, 5.0))
def test_a_corner_next_to_the_last_node_is_not_taken_for_sharp(
    sense: float, top: float, fall: float
) -> None:
    # lines through both pairs of nodes cross in the third node, whatever is behind it
    late = ABSCISSA - top
    values = sense * np.where(late < 0.0, late, -fall * late)
    _, value, error, _ = extreme_of(
        values, int(np.argmax(sense * values)), sense, -sense * np.inf, 1e-9
    )
    assert -sense * value <= max(error, 1e-12)


@SENSES
@pytest.mark.parametrize("curvature", [-0.1, 0.0, 0.1])
def test_what_rises_to_an_end_is_exact_there(sense: float, curvature: float) -> None:
    values = sense * (ABSCISSA + curvature * ABSCISSA**2)
    abscissa, value, error = extreme(values, sense)
    assert (abscissa, value, error) == (NODES - 1.0, values[-1], 0.0)


@SENSES
def test_what_rests_at_its_extreme_stays_there(sense: float) -> None:
    # a contact force that falls to zero: no polynomial through it may go below
    values = -sense * np.maximum(1.4 - ABSCISSA, 0.0) ** 1.5
    _, value, error = extreme(values, sense)
    assert (value, error) == (0.0, 0.0)


@SENSES
def test_two_samples_alike_do_not_rest(sense: float) -> None:
    abscissa, value, _ = extreme(sense * np.cos(0.5 * (ABSCISSA - 1.5)), sense)
    assert abscissa == pytest.approx(1.5, abs=1e-2)
    assert sense * value == pytest.approx(1.0, abs=1e-3)
