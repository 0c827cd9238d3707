"""Lanes of a certificate are made ready together, not one by one: counted, not timed."""

import sys
from types import FrameType
from typing import cast

from jointplay.solver.kinds import Admission, admit
from jointplay.solver.lanes.ready_lanes import make_ready
from jointplay.solver.runs.dynamic_run import DynamicRun

TIMES = 4
"""The run, companions from its state, those from perturbed ones, and windows of the exponent."""


def test_lanes_are_made_ready_together() -> None:
    scene = {"preset": "seven-bar-press"}
    job = {"kind": "simulate", "scene": scene, "duration": 1.0, "output_step": 1.0}
    admission = cast("Admission", admit(job))
    made = 0

    def count(frame: FrameType, event: str, _argument: object) -> None:
        nonlocal made
        made += event == "call" and frame.f_code is make_ready.__code__

    sys.setprofile(count)
    try:
        for _ in DynamicRun(admission).slices():
            pass
    finally:
        sys.setprofile(None)
    assert made == TIMES
