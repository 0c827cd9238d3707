"""Steps at the limit of stability are told from smooth ones by a late stage."""

import numpy as np
import pytest

from jointplay.solver.integrators import METHODS
from jointplay.solver.kernels.emit.judging import swings

LIMITS = {"tsitouras": -3.4, "bogacki-shampine": -2.5}
"""Step times rate at which a method is just stable."""
TOLERANCES = 100.0
"""Step by tolerance of a speed: a slope of 1 moves it by that many."""


def slopes(name: str, rate: complex) -> tuple[float, float, float]:
    """Return the slopes of y' = rate y, first, at the last stage but one and last; real parts."""
    method = METHODS[name]
    found = np.empty(0, complex)
    for row in method.matrix:
        y = 1.0 + rate * np.dot(row, found[: len(row)])
        found = np.append(found, y)
    return found[0].real, found[-2].real, found[-1].real


@pytest.mark.parametrize("method", LIMITS)
def test_a_step_at_the_limit_of_stability_swings(method: str) -> None:
    found = slopes(method, LIMITS[method])
    assert swings(*found, METHODS[method].nodes[-2], TOLERANCES) > 0.0
    assert swings(*found, METHODS[method].nodes[-2], 1e-6) <= 0.0  # too little to matter


@pytest.mark.parametrize("method", LIMITS)
@pytest.mark.parametrize("rate", [-0.3, 0.3, -0.05 + 0.3j])
def test_a_smooth_step_does_not(method: str, rate: complex) -> None:
    assert swings(*slopes(method, rate), METHODS[method].nodes[-2], TOLERANCES) <= 0.0
