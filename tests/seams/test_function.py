"""A function from outside: a crank that a parabola of time turns, without a change elsewhere."""

import math
from collections.abc import Iterator
from typing import Annotated, Any, Literal

import numpy as np
import pytest
from hypothesis import strategies as st
from pydantic import Field

from jointplay.client import Refused
from jointplay.solver.laws.function import FUNCTIONS, Derivatives, Function
from jointplay.solver.quantities.scalars import Scalar
from tests.seams.conftest import Platform
from tests.solver.laws.test_functions import FunctionSpecification


class Parabola(Function):
    """f(x) = curvature x² / 2."""

    type: Literal["parabola"]
    curvature: Annotated[
        float, Field(gt=0.0, le=1e3, json_schema_extra={"unit": "unit of the value per x²"})
    ]

    def at(self, x: Scalar) -> Derivatives:
        slope = self.curvature * x
        return Derivatives(0.5 * slope * x, slope, self.curvature)

    @property
    def period(self) -> float:
        return math.inf

    def largest(self, until: float) -> list[float]:
        return [self.curvature * until, self.curvature]


class TestParabola(FunctionSpecification):
    model = Parabola
    functions = st.builds(Parabola, type=st.just("parabola"), curvature=st.floats(0.1, 9.0))


def turned(**fields: Any) -> dict[str, Any]:
    """Return a job: a crank on the ground follows a parabola."""
    crank = {"mass": 1.0, "inertia": 0.5, "points": {"O": [0.0, 0.0]}}
    motion = {"type": "parabola", "curvature": 3.0} | fields
    scene = {
        "name": "parabola",
        "ground": {"points": {"O": [0.0, 0.0]}},
        "bodies": {"crank": crank},
        "joints": {"main": {"type": "revolute", "bearing": "ground.O", "journal": "crank.O"}},
        "drivers": {"motor": {"joint": "main", "motion": motion}},
    }
    return {"kind": "simulate", "scene": scene, "duration": 2.0, "output_step": 0.1}


@pytest.fixture
def parabola() -> Iterator[None]:
    FUNCTIONS["parabola"] = Parabola
    yield
    del FUNCTIONS["parabola"]


def test_a_function_that_is_in_no_registry_is_refused_at_its_type(platform: Platform) -> None:
    with pytest.raises(Refused) as refused:
        platform.client.submit(turned())
    (field,) = refused.value.fields
    assert field.pointer == "/scene/drivers/motor/motion/type"
    assert "'sinusoidal'" in field.detail


@pytest.mark.usefixtures("parabola")
def test_what_is_wrong_with_it_is_said_at_its_field(platform: Platform) -> None:
    with pytest.raises(Refused) as refused:
        platform.client.submit(turned(curvature=0.0))
    (field,) = refused.value.fields
    assert field.pointer == "/scene/drivers/motor/motion/curvature"
    assert "greater than 0" in field.detail


@pytest.mark.usefixtures("parabola")
def test_a_crank_is_turned_by_it(platform: Platform) -> None:
    job = platform.computed(turned())
    assert job.state == "succeeded"
    found = job.window(["crank.theta", "motor.torque"])
    np.testing.assert_allclose(found["crank.theta"], 1.5 * found.time**2, atol=1e-12)
    np.testing.assert_allclose(found["motor.torque"], 0.5 * 3.0, rtol=1e-12)
