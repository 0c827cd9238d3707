"""An explicit method from outside: the pair of Heun and Euler, one object and one registry line."""

from collections.abc import Iterator

import numpy as np
import pytest

from jointplay.client import Refused
from jointplay.records.failure import InvalidInput
from jointplay.solver.integrators import METHODS
from jointplay.solver.integrators.method import Method, cubic_dense
from jointplay.solver.kinds import admit
from tests.seams.conftest import Platform
from tests.solver.integrators import test_tableaux as specification

HALVES = (0.5, 0.5)
HEUN_EULER = Method(
    name="heun-euler",
    order=2,
    error_order=2,
    dense_order=2,
    largest_tolerance=1e-3,
    nodes=(0.0, 1.0, 1.0),
    matrix=((), (1.0,), HALVES),
    error=(-0.5, 0.5, 0.0),  # Heun's weights less Euler's
    dense=cubic_dense(HALVES),
)
SWING = {"scene": {"preset": "pendulum"}, "duration": 2.0}


@pytest.fixture
def heun() -> Iterator[None]:
    METHODS[HEUN_EULER.name] = HEUN_EULER
    yield
    del METHODS[HEUN_EULER.name]


def test_it_meets_the_specification_of_all_methods() -> None:
    specification.test_the_weights_meet_the_order_conditions(HEUN_EULER)
    specification.test_the_embedded_error_is_of_its_order(HEUN_EULER)
    specification.test_dense_output_ends_on_the_step(HEUN_EULER)
    specification.test_dense_output_starts_and_ends_with_the_slopes_of_the_step(HEUN_EULER)
    specification.test_dense_output_meets_the_conditions_of_its_order(HEUN_EULER, 0.37)
    specification.test_the_estimated_error_falls_with_its_order(HEUN_EULER)


def test_a_job_is_refused_by_a_name_that_is_in_no_registry(platform: Platform) -> None:
    with pytest.raises(Refused) as refused:
        platform.client.submit(SWING | {"kind": "simulate", "method": "heun-euler"})
    assert [field.pointer for field in refused.value.fields] == ["/method"]
    assert "'rodas' or 'rk4'" in refused.value.fields[0].detail


@pytest.mark.usefixtures("heun")
def test_a_simulation_asks_for_it_by_name(platform: Platform) -> None:
    job = platform.computed(SWING | {"kind": "simulate", "method": "heun-euler", "tolerance": 1e-6})
    assert job.state == "succeeded"
    statistics = job.statistics
    assert statistics["method"] == "heun-euler"
    assert statistics["method_reason"] == "asked for"
    angle = job.window("rod.theta")["rod.theta"]
    fine = platform.computed(SWING | {"kind": "simulate", "accuracy": "fine"})
    exact = fine.window("rod.theta")["rod.theta"]
    np.testing.assert_allclose(angle, exact, atol=1e-3)


@pytest.mark.usefixtures("heun")
def test_its_error_falls_with_the_square_of_its_evaluations(platform: Platform) -> None:
    job = platform.computed(
        SWING
        | {"kind": "accuracy-study", "methods": ["heun-euler"], "tolerances": [1e-5, 1e-6, 1e-7]}
    )
    assert job.state == "succeeded"
    points = [p for p in job.accuracy["points"] if p["method"] == "heun-euler"]
    work = np.log([point["evaluations"] for point in points])
    error = np.log([point["error"] for point in points])
    # steps are short enough that the leading term of the error rules to a few percent
    assert np.polyfit(work, error, 1)[0] == pytest.approx(-HEUN_EULER.order, abs=0.2)


@pytest.mark.usefixtures("heun")
def test_its_largest_tolerance_is_its_own() -> None:
    with pytest.raises(InvalidInput, match=r"ask for 0\.001 at most"):
        admit(SWING | {"kind": "simulate", "method": "heun-euler", "tolerance": 5e-3})
