"""Error bars of runs that pass knots, against true errors."""

import pytest

from benchmarks.extreme_cases import coverage_of
from tests.solver.knotted_scene import knotted_scene


@pytest.mark.parametrize("tolerance", [1e-5, 1e-7])
def test_the_error_bar_covers_the_true_error_at_knots(tolerance: float) -> None:
    job = {"kind": "simulate", "scene": knotted_scene(), "method": "tsitouras"}
    found = coverage_of(job | {"duration": 0.6, "tolerance": tolerance, "formulation": "reduced"})
    assert found is not None
    assert found.covered >= 0.95
    assert found.known >= 0.9  # else the reference, not the estimate, would be judged
    assert found.converged == 1.0  # of a motion without chaos all is claimed
