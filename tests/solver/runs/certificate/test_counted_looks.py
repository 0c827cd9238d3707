"""Companions of a certificate look into as few steps as runs do: counted, not timed."""

from typing import cast

from jointplay.solver.kinds import Admission, admit
from jointplay.solver.runs.dynamic_run import DynamicRun

LOOKS = 0.238
"""Counted: calls that tell channels inside a step, while each of eight lanes makes an attempt."""


def test_companions_that_hardly_swing_are_not_looked_into_at_every_step() -> None:
    scene = {"preset": "seven-bar-press", "parameters": {"friction": 0.1}}
    job = {"kind": "simulate", "scene": scene, "duration": 0.3, "output_step": 0.3}
    run = DynamicRun(cast("Admission", admit(job)))
    module, before = run.kernel.module, run.kernel.module.channels_within.call_count
    for _ in run.slices():
        pass
    looks = module.channels_within.call_count - before
    attempts = sum(group.attempts for group in run.bundle.groups) * run.bundle.width / 8
    assert 0 < looks <= (1.25 * LOOKS + 0.005) * attempts
