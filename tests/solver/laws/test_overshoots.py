"""Tables that pass their values: how far, which do, and what they are where nothing is said."""

import numpy as np
import pytest
from hypothesis import given

from jointplay.solver.laws.force import ELEMENTS
from jointplay.solver.laws.force.varying import Varying
from jointplay.solver.laws.function.table import Table
from jointplay.solver.scene.drivers import MovingDriver
from tests.solver.laws.test_functions import some, tables


@some
@given(table=tables())
def test_an_overshoot_is_how_far_the_densest_samples_pass_the_values_beside(table: Table) -> None:
    share, at = table.overshoot()
    if table.between == "monotone":
        assert share == 0.0
        return
    values, passed = table.values, 0.0
    for k in range(len(table.knots) - 1):
        inside = table.at(np.linspace(table.knots[k], table.knots[k + 1], 2001)[:-1]).value
        low, high = sorted(values[k : k + 2])
        passed = max(passed, float(np.max(inside)) - high, low - float(np.min(inside)))
    span = max(values) - min(values)
    assert share * span == pytest.approx(passed, abs=1e-5 * span)
    if passed > 1e-6 * span:
        piece = int(np.searchsorted(table.knots, at)) - 1
        low, high = sorted(values[piece : piece + 2])
        value = float(table.at(at).value)
        assert max(value - high, low - value) == pytest.approx(share * span, rel=1e-9)


PUNCH = {"type": "table", "knots": [-0.098, -0.096, -0.092, -0.09], "values": [0.0, 1.0, 1.0, 0.0]}


def test_a_force_stays_within_its_values_and_a_motion_has_a_second_derivative() -> None:
    held = PUNCH | {"outside": "held"}
    ends = {"first": "ground.O", "second": "ram.O", "magnitude": 2e4, "direction": [0.0, 1.0]}
    force = ELEMENTS["force"].model_validate({"type": "force", "course": held} | ends)
    driver = MovingDriver.model_validate({"joint": "O", "motion": held})
    assert isinstance(force, Varying)
    assert (force.model_dump()["course"]["between"], driver.motion.between) == (
        "monotone",
        "smooth",
    )
    x = np.linspace(-0.1, -0.088, 1201)
    assert np.max(force.course.at(x).value) == pytest.approx(1.0, abs=1e-12)
    share, at = driver.motion.overshoot()
    assert (share, at) == (pytest.approx(0.6), pytest.approx(-0.094))
    assert driver.motion.at(at).value == pytest.approx(1.6)
    said = {"type": "force", "course": held | {"between": "smooth"}} | ends
    kept = ELEMENTS["force"].model_validate(said)
    assert isinstance(kept, Varying)
    assert kept.course.between == "smooth"
