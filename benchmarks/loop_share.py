"""Share of a run that its attempts at a step take, where ideal joints close loops.

    python -m benchmarks loop_share

Slopes, projection and judging are all in the attempt: a closed form of the loops cannot save more.
Eight lanes of a preset run to the same end at tolerance 1e-8, with extremes; best of several runs.
"""

import time

from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.kernels.target import own_target
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import LaneProblem
from jointplay.solver.scene import presets
from jointplay.solver.scene.document import Scene

LANES = own_target().lanes

SHOWN = ("slopes", "right_hand_side", "project", "judge")
PRESETS = {"andrews-squeezer": 0.03, "jansen-leg": 0.3, "quick-return": 0.3}
"""Closed loops, and how long each runs, s."""
REPEATS, CALLS = 40, 2000


def lines(kernel: Kernel) -> dict[str, int]:
    """Return how many lines each function of a kernel has."""
    return {one.name: len(one.lines) for one in kernel.module.sources}


def attempt_seconds(bundle: Bundle) -> float:
    """Return the processor time of attempting a bundle's next step, s."""
    attempt, work = bundle.kernel.module.attempt, bundle.groups[0].work
    begun = time.process_time()
    for _ in range(CALLS):
        attempt(work)
    return (time.process_time() - begun) / CALLS


def step_seconds(bundle: Bundle) -> float:
    """Return the processor time of a step, of a bundle's whole run, s."""
    begun = time.process_time()
    bundle.advance(10**8)
    return (time.process_time() - begun) / bundle.lane(0).attempts


def main() -> None:
    """Print lines of functions, and microseconds of a step of eight lanes."""
    print(
        "preset            " + "".join(f"{name:>16}" for name in SHOWN) + "  attempt   step  share"
    )
    for name, duration in PRESETS.items():
        scene = Scene.model_validate(presets.document(name))
        kernel = ready_kernel(scene, "reduced", "tsitouras")
        problems = [LaneProblem(scene, duration, 1e-8, duration, 0, 0, 0.0)] * LANES
        bundle = Bundle(kernel, problems)
        bundle.advance(20)
        attempt = min(attempt_seconds(bundle) for _ in range(REPEATS))
        step = min(step_seconds(Bundle(kernel, problems)) for _ in range(REPEATS))
        count = lines(kernel)
        print(
            f"{name:<18}"
            + "".join(f"{count[shown]:16d}" for shown in SHOWN)
            + f"{1e6 * attempt:9.2f}{1e6 * step:7.2f}{attempt / step:7.0%}"
        )


if __name__ == "__main__":
    main()
