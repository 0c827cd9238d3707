"""Instants that a window of an ideal mechanism is sought at: bounded, however much bends."""

import numpy as np
import pytest

from jointplay.solver.runs.dense_output.exact_motion import MOST, MOST_TOGETHER, instants

PERIOD = 6.0


@pytest.mark.parametrize("bins", [1, 3, 2000])
@pytest.mark.parametrize("width", [0.1 * PERIOD, 10.0 * PERIOD])
@pytest.mark.parametrize("fineness", [1e-3, 300.0, 1e9])
def test_instants_are_bounded_and_reach_both_ends(bins: int, width: float, fineness: float) -> None:
    edges = width * np.arange(bins + 1.0)
    found = instants(edges[:-1, None], edges[1:, None], PERIOD, lambda span: int(fineness * span))
    assert found.size <= max(MOST_TOGETHER, bins * MOST)
    np.testing.assert_array_equal(found[:, 0], edges[:-1])
    np.testing.assert_array_equal(found[:, -1], edges[1:])
    assert (np.diff(found, axis=1) > 0.0).all()
