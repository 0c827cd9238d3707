"""The press over one revolution: solver time, alone and with eight lanes busy, and its error.

The case: clearance 0.5 mm, stiffness 5e9, restitution 0.7, bearing radius 10 mm, friction 0.1,
limit velocities 1e-3 and 1e-2 m/s; peaks of all channels, output every 10 ms. Times are the
median and the best of repeated runs, kernels warm. With eight lanes busy, 64 presses of clearances
from 0.3 to 0.6 mm wait for lanes; the bare column seeks no extremes and writes no output.
"""

import statistics
import time
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from benchmarks.busy_lanes import CLEARANCES, busy_lanes
from jointplay.solver.integrators import METHODS
from jointplay.solver.kernels.emit.kernel import Kernel, compile_kernel
from jointplay.solver.kinds import Admission, admit
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import LaneProblem
from jointplay.solver.mechanics.tree import spanning_tree

CASE = {
    "stiffness": 5e9,
    "restitution": 0.7,
    "bearing_radius": 0.01,
    "friction": 0.1,
    "static_velocity": 1e-3,
    "dynamic_velocity": 1e-2,
}
REPEATS, REPEATS_TOGETHER = 40, 7
CHECK_TIME = 0.03


def problem(
    clearance: float, tolerance: float, duration: float, case: Mapping[str, float] = CASE
) -> LaneProblem:
    """Return the case for one lane."""
    parameters = {**case, "clearance": clearance}
    admission = admit(
        {
            "kind": "simulate",
            "scene": {"preset": "seven-bar-press", "parameters": parameters},
            "duration": duration,
            "tolerance": tolerance,
            "output_step": 0.01,
        }
    )
    assert isinstance(admission, Admission)
    scene = admission.scene
    return LaneProblem(scene, duration, tolerance, 0.01, admission.samples, admission.sections, 0.0)


def compiled() -> Kernel:
    """Return the case's kernel, its loop warm."""
    scene = problem(5e-4, 1e-6, 2.0).scene
    kernel = compile_kernel(scene, spanning_tree(scene), "reduced", METHODS["tsitouras"])
    Bundle(kernel, [problem(5e-4, 1e-6, 0.01)]).advance(1000)
    return kernel


def timed(kernel: Kernel, problems: list[LaneProblem]) -> tuple[list[float], Bundle]:
    """Return the seconds of repeated runs, and the last bundle."""
    seconds = []
    for _ in range(REPEATS):
        bundle = Bundle(kernel, problems)
        begun = time.perf_counter()
        while bundle.advance(10_000_000):
            pass
        seconds.append(time.perf_counter() - begun)
    return seconds, bundle


def together(kernel: Kernel, problems: list[LaneProblem], *, watch: bool = True) -> list[float]:
    """Return the seconds a problem of repeated runs with eight lanes busy."""
    return [busy_lanes(kernel, problems, watch=watch)[0] for _ in range(REPEATS_TOGETHER)]


def state_at_check(kernel: Kernel, tolerance: float) -> np.ndarray:
    """Return coordinates and speeds at 0.03 s."""
    bundle = Bundle(kernel, [problem(5e-4, tolerance, CHECK_TIME)])
    bundle.advance(10_000_000)
    return bundle.lane(0)["y"].copy()


def main() -> None:
    """Print times and errors by tolerance."""
    kernel = compiled()
    reference = state_at_check(kernel, 1e-13)
    half = kernel.states // 2
    print("tolerance  alone: best, median  8 busy: best, median  bare    steps    error at 0.03 s")
    print("             ms a revolution     ms a revolution and lane           position  velocity")
    for tolerance in (1e-5, 1e-6, 1e-8, 1e-10):
        alone, bundle = timed(kernel, [problem(5e-4, tolerance, 2.0)])
        presses = [problem(c, tolerance, 2.0) for c in CLEARANCES]
        busy = together(kernel, presses)
        silent = [replace(press, output_step=2.0, samples=0) for press in presses]
        bare = together(kernel, silent, watch=False)
        error = np.abs(state_at_check(kernel, tolerance) - reference)
        print(
            f"{tolerance:8.0e} {1e3 * min(alone):11.2f} {1e3 * statistics.median(alone):7.2f}"
            f" {1e3 * min(busy):13.2f} {1e3 * statistics.median(busy):7.2f}"
            f" {1e3 * statistics.median(bare):7.2f} {bundle.lane(0).attempts:8.0f}"
            f" {error[:half].max():11.1e} {error[half:].max():9.1e}"
        )
    long = together(kernel, [problem(c, 1e-6, 20.0) for c in CLEARANCES[::4]])
    each = 1e2 * statistics.median(long)
    print(f"ten revolutions each, 8 lanes, 1e-6: {each:.2f} ms a revolution")


if __name__ == "__main__":
    main()
