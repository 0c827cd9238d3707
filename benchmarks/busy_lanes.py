"""Eight lanes kept busy, as in a sweep: one that ends takes the next problem of a queue."""

import time
from collections.abc import Sequence

import numpy as np

from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.kernels.loop.runs import Status
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import LaneProblem

PRESSES = 64
CLEARANCES = [float(clearance) for clearance in np.linspace(3e-4, 6e-4, PRESSES)]
"""Radial clearances of the presses, m."""


def busy_lanes(
    kernel: Kernel, problems: Sequence[LaneProblem], *, watch: bool
) -> tuple[float, float]:
    """Return processor time in kernels and attempts at a step, both a problem.

    The time in which the queue's last problems leave lanes idle counts; that in which Python loads
    problems does not. `watch` says whether extremes are sought.
    """
    bundle = Bundle(kernel, problems[:8], watch=watch)
    waiting = list(problems[8:])
    seconds, made, running = 0.0, 0.0, True
    while running:
        begun = time.process_time()
        running = bundle.advance(10_000_000) > 0
        seconds += time.process_time() - begun
        for lane in np.flatnonzero(bundle.runs["status"] != Status.RUNNING).tolist():
            if waiting:
                made += bundle.lane(lane).attempts
                bundle.load(lane, waiting.pop(0))
                running = True
    made += sum(bundle.lane(lane).attempts for lane in range(8))
    return seconds / len(problems), made / len(problems)
