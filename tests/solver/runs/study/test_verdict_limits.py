"""Limits of verdicts: what indicators could not tell, and a contact that never ends."""

import math
from typing import Any

import pytest

from benchmarks.basin_scenes import ON_THE_MASS, shaking, sliding
from jointplay.solver.nonlinear.verdict import PERIODIC, UNDECIDED
from tests.solver.completed_runs import CASE_3
from tests.solver.runs.study.test_run import Computed


def judged(parameters: dict[str, float], record: int, **more: Any) -> tuple[dict[str, float], str]:
    """Return indicators of a press and the grounds of its verdict."""
    scene = {"preset": "seven-bar-press", "parameters": CASE_3 | parameters}
    asked = {"settle": 1, "record": record, "tolerance": 1e-6}
    job = {"kind": "poincare", "scene": scene} | asked | more
    end = Computed({"indicators": "all", **job}).ends[0]
    return dict(end.indicators), end.reason


@pytest.mark.parametrize(
    ("record", "said"),
    [
        (2, ["three recorded periods", "needs 300", "needs 4 sections, there are 2", "needs 16"]),
        (20, ["needs 300 sections", "periods up to 6 are looked for", "0.001 of the finest"]),
    ],
)
def test_an_indicator_of_too_few_sections_says_why_it_says_nothing(
    record: int, said: list[str]
) -> None:
    found, reason = judged({}, record)
    assert all(sentence in reason for sentence in said), reason
    assert math.isnan(found["period"]) == (record < 4)
    assert math.isnan(found["flatness"]) == (record < 16)
    assert found["verdict"] == UNDECIDED


def test_sections_within_a_period_give_no_exponent_and_say_so() -> None:
    found, reason = judged({}, 2, settle=0, section={"onset": "A"})
    assert math.isnan(found["lyapunov"])
    assert "there is no exponent: it needs a whole period" in reason


def test_friction_that_jumps_is_named_where_there_is_no_exponent() -> None:
    found, reason = judged({"dynamic_velocity": 1e-3, "static_velocity": 1e-3}, 1)
    assert math.isnan(found["lyapunov"])
    assert "there is no exponent: friction jumps" in reason


def test_a_contact_that_lasts_makes_the_motion_the_laws() -> None:
    # soft contact at rest in gravity: both journals stay where they fell to
    _, resting = judged({"speed": 0.5, "speed_crank4": -0.5}, 1)
    assert "contact lasted throughout in A (" in resting
    assert "lankarani-nikravesh" in resting
    _, rattling = judged({"speed": 7.854, "speed_crank4": -7.854}, 4)
    assert "contact lasted" not in rattling


@pytest.mark.parametrize("rate", [30.0, 300.0])
def test_a_tangent_that_vanishes_gives_no_exponent_for_certain(rate: float) -> None:
    """Neighbours of a critically damped motion come closer by e^-1885 in a period at 300 1/s."""
    spring = {"type": "spring-damper", **ON_THE_MASS, "stiffness": rate * rate}
    scene = sliding("damped", 2.0 * rate, spring=spring, shaking=shaking(rate * rate))
    asked = {"settle": 20, "record": 20, "indicators": ["lyapunov", "recurrence"]}
    end = Computed({"kind": "poincare", "scene": scene} | asked).ends[0]
    found = end.indicators
    assert abs(found["lyapunov"] + rate) <= 3.0 * found["lyapunov_error"]
    assert math.isfinite(found["lyapunov"]) == (rate < 100.0)
    assert ("the tangent vanished" in end.reason) == (rate > 100.0)
    assert end.reason.count("not known") == int(rate > 100.0)
    assert found["verdict"] == PERIODIC
