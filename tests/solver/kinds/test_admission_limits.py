"""Jobs too large for the service are refused at once, with their size and the limit."""

from typing import Any

import pytest

from jointplay.records.failure import InvalidInput, LimitExceeded
from jointplay.solver.kinds import admit, parse
from jointplay.solver.kinds.limits import LONGEST_RUN, MOST_SAMPLES
from jointplay.solver.mechanics import assembly
from jointplay.solver.scene.channels import MOST_GLOBS, MOST_UNKNOWN
from tests.solver.random_mechanisms import chain

JOB: dict[str, Any] = {
    "kind": "simulate",
    "scene": {"preset": "seven-bar-press", "parameters": {}},
    "duration": 2.0,
}


def assert_points(error: InvalidInput, pointer: str, words: str) -> None:
    found = {problem.pointer: problem.detail for problem in error.problems}
    assert pointer in found, found
    assert words in found[pointer], found[pointer]
    for problem in error.problems:
        assert problem.detail.endswith((".", "?")), problem
        assert "\n" not in problem.detail


def test_a_duration_over_the_limit_is_refused_with_the_estimate() -> None:
    with pytest.raises(LimitExceeded) as refused:
        admit({**JOB, "duration": 2.5 * LONGEST_RUN, "output_step": 1000.0})
    assert_points(refused.value, "/duration", "1.25e+06 periods")


def test_too_many_fixed_steps_are_refused_with_their_number() -> None:
    with pytest.raises(LimitExceeded) as refused:
        admit({**JOB, "method": "rk4", "step": 1e-10})
    assert_points(refused.value, "/step", "2e+10 steps")
    admit({**JOB, "method": "rk4", "step": 5e-10})


def test_too_many_samples_are_refused_with_the_estimate() -> None:
    with pytest.raises(LimitExceeded) as refused:
        admit({**JOB, "output_step": 1e-9})
    assert_points(refused.value, "/output_step", "2e+09 samples")
    assert f"{MOST_SAMPLES:g}" in refused.value.problems[0].detail


def test_too_many_bytes_are_refused_with_the_estimate() -> None:
    with pytest.raises(LimitExceeded) as refused:
        admit({**JOB, "output_step": 1e-7})
    assert_points(refused.value, "/output_step", "GB")
    admit({**JOB, "output_step": 1e-7, "channels": ["slider7.x"]})


def test_equations_too_long_to_compile_are_refused_with_their_length() -> None:
    scene = chain(40).model_dump()
    with pytest.raises(LimitExceeded) as refused:
        admit({"kind": "simulate", "scene": scene, "duration": 1.0})
    assert_points(refused.value, "/scene", "statements")


def test_equations_too_long_to_compile_are_refused_before_anything_is_assembled() -> None:
    before = dict(assembly._found)
    with pytest.raises(LimitExceeded):
        admit({"kind": "simulate", "scene": chain(63).model_dump(), "duration": 1.0})
    assert assembly._found == before  # 60 bodies take seconds to assemble


def test_the_largest_scene_that_is_admitted_is_parsed_again() -> None:
    """Accepted jobs run: all channels of 96 bodies are listed in the job that workers read."""
    bodies = {f"b{i}": {"mass": 1.0, "inertia": 1.0, "points": {"a": [0, 0]}} for i in range(96)}
    clearance = {
        "radial_clearance": 1e-3,
        "bearing_radius": 1e-2,
        "contact": {"law": "lankarani-nikravesh", "stiffness": 1e9, "restitution": 0.9},
        "friction": {"law": "modified-coulomb", "coefficient": 0.1},
    }
    joints = {
        f"at-{name}": {
            "type": "revolute",
            "bearing": "ground.O",
            "journal": f"{name}.a",
            "clearance": clearance,
        }
        for name in bodies
    }
    scene = {"name": "x", "ground": {"points": {"O": [0, 0]}}, "bodies": bodies, "joints": joints}
    admitted = admit({"kind": "simulate", "scene": scene, "duration": 0.1})
    assert len(admitted.job["channels"]) > 1200
    assert parse(admitted.job) == admitted


def test_wrong_names_and_patterns_cost_little() -> None:
    """However many: each is compared with every channel, so few are named or matched."""
    names = [f"no.{i}" for i in range(4096)]
    with pytest.raises(InvalidInput) as refused:
        admit({**JOB, "channels": names})
    assert len(refused.value.problems) == MOST_UNKNOWN
    with pytest.raises(InvalidInput, match="may be patterns"):
        admit({**JOB, "channels": ["slider7.?"] * (MOST_GLOBS + 1)})
    every = [channel.name for channel in admit(JOB).channels]
    assert admit({**JOB, "channels": every * 10}).channels == admit(JOB).channels
