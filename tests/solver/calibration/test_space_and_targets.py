"""Coordinates of parameters, and how far numbers are from their targets."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from jointplay.solver.calibration.document import CalibrationTarget, FreeParameter
from jointplay.solver.calibration.space import space_of
from jointplay.solver.calibration.targets import goals_of, grid_indices
from jointplay.solver.calibration.windows import Windows
from tests.solver.calibration.calibrations import coordinates

SPACE = space_of(
    {
        "stiffness": FreeParameter(minimum=1e7, maximum=1e11, spacing="log"),
        "exponent": FreeParameter(minimum=1.0, maximum=1.7),
        "gravity": FreeParameter(minimum=-9.81, maximum=0.0),
    }
)


@given(st.lists(st.floats(0.0, 1.0), min_size=3, max_size=3))
def test_coordinates_and_parameters_lead_back_and_forth(unit):
    values = SPACE.values(np.array([unit]))
    assert (SPACE.minimum <= values).all()
    assert (values <= SPACE.maximum).all()
    # rounding of a logarithm over its range, a few units in the last place
    np.testing.assert_allclose(coordinates(SPACE, values)[0], unit, rtol=0, atol=1e-14)


def test_the_corners_are_the_bounds_exactly():
    ends = SPACE.values(np.array([[0.0] * 3, [1.0] * 3]))
    np.testing.assert_array_equal(ends, [SPACE.minimum, SPACE.maximum])
    assert len(SPACE.corners()) == 8
    assert {corner["exponent"] for corner in SPACE.corners()} == {1.0, 1.7}


def test_halfway_in_ratios_is_the_geometric_mean():
    half = SPACE.values(np.full((1, 3), 0.5))[0]
    np.testing.assert_allclose(half, [1e9, 1.35, -4.905], rtol=1e-14)  # rounding


def target(**fields: object) -> CalibrationTarget:
    return CalibrationTarget.model_validate({"channel": "a", "to": 1.0, **fields})


def test_misses_are_counted_in_tolerances_and_nothing_is_missed_between_limits():
    goals = goals_of(
        [
            target(value=100.0),
            target(value=-2.0, relative_tolerance=0.5),
            target(value=1.0, absolute_tolerance=0.1),
            target(between=[1.0, 2.0], absolute_tolerance=0.5),
            target(between=[None, 10.0], relative_tolerance=0.1),
        ]
    )
    values = np.array([[110.0, -2.5, 0.9, 1.5, -1e9], [95.0, -1.0, 1.0, 3.0, 13.0]])
    expected = [[2.0, -0.5, -1.0, 0.0, 0.0], [-1.0, 1.0, 0.0, 2.0, 3.0]]
    np.testing.assert_allclose(goals.misses(values), expected, rtol=1e-12, atol=1e-12)  # rounding


def test_the_cost_is_the_weighted_root_mean_square_and_leaves_out_what_has_no_weight():
    goals = goals_of(
        [
            target(value=1.0, absolute_tolerance=1.0, weight=3.0),
            target(value=1.0, absolute_tolerance=1.0),
            target(value=1.0, absolute_tolerance=1.0, weight=0.0),
        ]
    )
    values = np.array([[3.0, 1.0, np.nan], [1.0, 5.0, 99.0], [np.nan, 1.0, 1.0]])
    np.testing.assert_allclose(goals.costs(values), [np.sqrt(3.0), 2.0, np.inf], rtol=1e-15)


@pytest.mark.parametrize(
    ("start", "stop", "step", "indices"),
    [
        (0.0, 0.006, 2e-4, range(31)),
        (0.0, 0.0059, 2e-4, range(30)),
        (0.0046, 0.0046 + 1e-9, 2e-4, range(23, 24)),  # 23 * 2e-4 is not 0.0046 to the last bit
        (0.00461, 0.0047, 2e-4, range(24, 24)),
    ],
)
def test_the_ends_of_a_window_belong_to_its_grid(start, stop, step, indices):
    assert grid_indices(start, stop, step) == indices


def test_a_run_that_is_read_off_at_its_start_alone_has_an_end():
    found = Windows([target(statistic="maximum", value=1.0, to=0.5, sampled=1.0)])
    assert found.legs == (0.5,)
    assert found.samples == 2
