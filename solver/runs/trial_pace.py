"""The pace of this processor with the mechanism by which devices are tried."""

import time
from collections.abc import Sequence

from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import LaneProblem
from jointplay.solver.scene.document import Scene

ATTEMPTS = 2000
"""Steps that a device's trial compares, and then times: two revolutions each."""
TIMED = 10 * ATTEMPTS
"""Steps of each lane that are timed: some ten milliseconds."""


def trial_problems(scenes: Sequence[Scene]) -> list[LaneProblem]:
    """Return the problems of a trial: runs of mechanisms of one structure, which do not end."""
    return [LaneProblem(scene, 1e6, 1e-6, 1e6, 1, 0, 0.0) for scene in scenes]


def trial_pace(scenes: Sequence[Scene]) -> float:
    """Return how many accepted steps of mechanisms a core makes a second.

    Parameters
    ----------
    scenes
        Of one structure, as many as a bundle has lanes.
    """
    problems = trial_problems(scenes)
    bundle = Bundle(ready_kernel(problems[0].scene, "reduced"), problems, watch=False)

    def advance(attempts: int) -> float:
        while bundle.attempts < attempts:
            bundle.advance(attempts - bundle.attempts)
        return sum(bundle.lane(i).number("steps") for i in range(len(problems)))

    before, begun = advance(ATTEMPTS), time.process_time()
    return (advance(ATTEMPTS + TIMED) - before) / (time.process_time() - begun)
