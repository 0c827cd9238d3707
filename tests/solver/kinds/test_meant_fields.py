"""A field of the job among the parameters of its scene, where clients put what they do not know."""

from typing import Any

import pytest

from jointplay import jobs
from jointplay.records.failure import InvalidInput, Problem
from jointplay.solver.kinds import admit


def problems(document: dict[str, Any]) -> list[Problem]:
    with pytest.raises(InvalidInput) as refused:
        admit(document)
    return list(refused.value.problems)


@pytest.mark.parametrize(
    ("given", "field"),
    [
        ({"tolerence": 1e-6}, "tolerance"),
        ({"outputStep": 0.1}, "output_step"),
        ({"chanels": ["pin.x"]}, "channels"),  # no value of a parameter
    ],
)
def test_the_field_is_named(given: dict[str, Any], field: str) -> None:
    """The parameters of the scene were listed, and nothing said what was misspelt."""
    (name,) = given
    (problem,) = problems(jobs.simulate("pendulum", duration=1.0, **given))
    assert problem.pointer == f"/scene/parameters/{name}"
    expected = f"There is no parameter '{name}'; of the fields of the job, did you mean '{field}'?"
    assert problem.detail == expected


def test_one_beside_other_errors_is_named_too() -> None:
    _, problem = problems(jobs.simulate("pendulum", duration=-1.0, tolerence=1e-6))
    assert problem.detail.endswith("of the fields of the job, did you mean 'tolerance'?")


def test_fields_are_those_of_the_kind() -> None:
    (problem,) = problems(jobs.simulate("pendulum", duration=1.0, record_=3.0))
    assert "of the job" not in problem.detail


def test_a_parameter_that_is_near_is_meant_first() -> None:
    (problem,) = problems(jobs.simulate("four-bar", duration=1.0, clearence=1e-4))
    assert problem.detail == "There is no parameter 'clearence'; did you mean 'clearance'?"


def test_what_is_near_to_nothing_is_answered_with_the_parameters() -> None:
    (problem,) = problems(jobs.simulate("pendulum", duration=1.0, xyzzy=1.0))
    assert problem.detail.startswith("There is no parameter 'xyzzy'; there are: ")
