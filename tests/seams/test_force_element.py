"""A force element from outside: a winch that pulls two points together with a constant force."""

import math
from collections.abc import Iterator
from typing import Annotated, Any, ClassVar, Literal

import numpy as np
import pytest
from hypothesis import strategies as st
from pydantic import Field

from jointplay.client import Refused
from jointplay.solver.laws.force import ELEMENTS, Effect, Ends, ForceElement
from jointplay.solver.quantities.scalars import sqrt
from tests.seams.conftest import Platform
from tests.solver.laws.specification.element import ElementSpecification


class Winch(ForceElement):
    """T = constant, along the line between the points.

    Assumes that rope is taken in at any speed. Fails where the points meet.

    Source: the definition of work, d(stored) = T dL; Goldstein 1980, Classical Mechanics, 1.1.
    """

    type: Literal["winch"]
    tension: Annotated[float, Field(gt=0.0, le=1e9, json_schema_extra={"unit": "N"})]
    channels: ClassVar[tuple[tuple[str, str, str], ...]] = (("rope", "m", "length of the rope"),)

    def effect(self, ends: Ends) -> Effect:
        x, y = ends.gap
        rope = sqrt(x * x + y * y)
        pull = self.tension / rope
        return Effect((-(pull * x), -(pull * y)), {"rope": rope}, stored=self.tension * rope)

    @property
    def needs_direction(self) -> bool:
        return True


class TestWinch(ElementSpecification):
    model = Winch
    elements = st.builds(
        Winch,
        type=st.just("winch"),
        first=st.just("ground.post"),
        second=st.just("sledge.eye"),
        tension=st.floats(1e-3, 1e3),
    )


MASS, TENSION, DISTANCE = 4.0, 10.0, 3.0


def hauled(**fields: Any) -> dict[str, Any]:
    """Return a job: a sledge on rails is pulled towards a post, 3 m away."""
    winch = {"type": "winch", "first": "ground.post", "second": "sledge.eye", "tension": TENSION}
    return {
        "kind": "simulate",
        "scene": {
            "name": "hauled-sledge",
            "ground": {"points": {"post": [DISTANCE, 0.0], "rails": [0.0, 0.0]}},
            "bodies": {"sledge": {"mass": MASS, "inertia": 1.0, "points": {"eye": [0.0, 0.0]}}},
            "joints": {
                "rails": {
                    "type": "prismatic",
                    "guide": "ground.rails",
                    "slider": "sledge.eye",
                    "axis": [1.0, 0.0],
                }
            },
            "forces": {"winch": winch | fields},
        },
        "duration": 1.0,
        "output_step": 0.01,
        "tolerance": 1e-9,
    }


@pytest.fixture
def winch() -> Iterator[None]:
    ELEMENTS["winch"] = Winch
    yield
    del ELEMENTS["winch"]


def test_an_element_that_is_in_no_registry_is_refused_at_its_type(platform: Platform) -> None:
    with pytest.raises(Refused) as refused:
        platform.client.submit(hauled())
    (field,) = refused.value.fields
    assert field.pointer == "/scene/forces/winch/type"
    assert "'spring-damper'" in field.detail


@pytest.mark.usefixtures("winch")
@pytest.mark.parametrize(
    ("fields", "pointer", "words"),
    [
        ({"tension": 0.0}, "/tension", "greater than 0 N"),
        ({"first": "ground.pole"}, "/first", "point of 'ground'"),
        ({"first": "ground.rails"}, "", "coincide at the start"),
    ],
)
def test_what_is_wrong_with_it_is_said_at_its_fields(
    platform: Platform, fields: dict[str, Any], pointer: str, words: str
) -> None:
    with pytest.raises(Refused) as refused:
        platform.client.submit(hauled(**fields))
    (field,) = refused.value.fields
    assert field.pointer == f"/scene/forces/winch{pointer}"
    assert words in field.detail


@pytest.mark.usefixtures("winch")
@pytest.mark.parametrize(
    "formulation", [pytest.param("reduced", marks=pytest.mark.long), "lagrange"]
)
def test_a_sledge_is_hauled_by_it(platform: Platform, formulation: str) -> None:
    job = platform.computed(hauled() | {"formulation": formulation})
    assert job.state == "succeeded"
    found = job.window(["sledge.x", "winch.rope"])
    moved = 0.5 * TENSION / MASS * found.time**2
    # tolerance 1e-9 a step of local error, relative to 1 m/s, over some hundred steps
    np.testing.assert_allclose(found["sledge.x"], moved, atol=1e-7)
    np.testing.assert_allclose(found["winch.rope"], DISTANCE - moved, atol=1e-7)
    assert found.channels["winch.rope"].unit == "m"
    energy = job.statistics["energy"]
    assert energy["kinetic_change"] == pytest.approx(TENSION * moved[-1], rel=1e-6)
    assert energy["stored_change"] == pytest.approx(-TENSION * moved[-1], rel=1e-6)
    assert energy["element_loss"] == pytest.approx(0.0, abs=1e-9)
    assert abs(energy["residual"]) < 1e-6 * energy["gross_work"]
    assert math.isfinite(job.certificate["horizon"])


@pytest.mark.usefixtures("winch")
def test_a_study_varies_its_parameter(platform: Platform) -> None:
    document = hauled()
    document["scene"]["parameters"] = {
        "pull": {"help": "Tension.", "unit": "N", "targets": [{"path": "/forces/winch/tension"}]}
    }
    sweep = {"kind": "sweep", "grid": {"pull": [5.0, 10.0]}, "duration": 1.0}
    job = platform.computed({"scene": document["scene"], "channels": ["sledge.x"]} | sweep)
    assert job.state == "succeeded"
    furthest = job.study(channels=["sledge.x"]).peaks("sledge.x").maximum
    np.testing.assert_allclose(furthest, [0.5 * pull / MASS for pull in (5.0, 10.0)], rtol=1e-5)
