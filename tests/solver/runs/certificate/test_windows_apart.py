"""Windows of an exponent are apart, so that its standard error is that of as many measurements."""

import math
from typing import Any

import pytest

from jointplay.solver.kinds import admit
from jointplay.solver.runs.certificate.certificate import TOO_SHORT
from jointplay.solver.runs.dynamic_run import DynamicRun

PERIOD = 2.0 * math.pi / 24.0


def computed(periods: int) -> tuple[DynamicRun, dict[str, Any]]:
    """Return a run of the impact oscillator, some 110 steps a period, and its certificate."""
    scene = {"preset": "impact-oscillator", "parameters": {"speed": 24.0}}
    duration = periods * PERIOD
    job = {"kind": "simulate", "scene": scene, "duration": duration, "output_step": PERIOD}
    run = DynamicRun(admit(job | {"certificate": True}))
    for _ in run.slices():
        pass
    certificate = run.certificate()
    assert certificate is not None
    return run, certificate.facts


@pytest.mark.parametrize("periods", [4, 8, 16])
def test_no_window_goes_on_where_the_next_one_begins(periods: int) -> None:
    run, facts = computed(periods)
    windows = run.survey.windows
    duration = periods * PERIOD
    assert (windows.times <= [*windows.begins[1:], duration]).all()
    assert facts["exponent"]["windows"] > 5
    assert facts["exponent"]["time"] < duration
    assert windows.bundle.attempts <= run.bundle.lane(0).attempts / 8


def test_a_run_of_few_steps_has_no_exponent_and_says_why() -> None:
    _, facts = computed(1)
    assert facts["exponent"] is None
    assert facts["exponent_note"] == TOO_SHORT
