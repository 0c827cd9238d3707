"""Rounding of channels is told from corners, jumps and narrow peaks by how often values turn."""

import numpy as np
import pytest

from jointplay.solver.kernels.jit import kernel
from jointplay.solver.kernels.loop.extremes.rounding import zigzags


@kernel()
def turns(values: np.ndarray) -> bool:
    return bool(zigzags(values, 0, len(values)))


@pytest.mark.parametrize(
    "values",
    [
        [0.0, 1.0, 2.0, 1.0, 0.0],  # a corner
        [0.0, 1.0, 0.9, 0.8, 0.7],  # a steep side
        [0.0, 0.0, 1.0, 0.99, 0.98],  # a jump, and on
        [1.0, 1.1, 1.2, 0.0, 0.0, 0.0],
        [0.0, 0.0, 1.0, 0.0, 0.0],  # a narrow peak
        [0.0, 0.7, 1.0, 0.7, 0.0],
        [0.0, 0.0, 0.0, 0.0, 0.0],
    ],
)
def test_what_turns_once_is_no_rounding(values: list[float]) -> None:
    for sense in (1.0, -1.0):
        assert not turns(sense * np.array(values))
        assert not turns(sense * np.array(values[::-1]))


def test_what_turns_again_is() -> None:
    # a force that nothing carries, N: quarters of a step of the press
    assert turns(np.array([4.6e-14, -3.8e-14, -2.5e-15, -8.6e-15, -8.1e-14, 1e-14]))
    assert turns(np.array([0.0, 1.0, 0.0, 1.0, 0.5]))
