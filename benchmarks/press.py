"""The press over one revolution: solver time, alone and with eight lanes busy, and its error.

The case: clearance 0.5 mm, stiffness 5e9, restitution 0.7, bearing radius 10 mm, friction 0.1,
limit velocities 1e-3 and 1e-2 m/s; peaks of all channels, output every 10 ms. Times are the
median and the best of repeated runs, kernels warm.
"""

import statistics
import time

import numpy as np

from solver.admission import admit
from solver.compiler.kernel import Kernel, compile_kernel
from solver.integrators import METHODS
from solver.lanes.bundle import Bundle
from solver.lanes.problem import LaneProblem
from solver.lanes.state import Counter
from solver.mechanics.tree import spanning_tree
from solver.scene.document import Scene

CASE = {
    "stiffness": 5e9,
    "restitution": 0.7,
    "bearing_radius": 0.01,
    "friction": 0.1,
    "static_velocity": 1e-3,
    "dynamic_velocity": 1e-2,
}
REPEATS = 40
CHECK_TIME = 0.03


def problem(clearance: float, tolerance: float, duration: float) -> LaneProblem:
    """Return the case for one lane."""
    parameters = CASE | {"clearance": clearance}
    admission = admit(
        {
            "kind": "simulate",
            "scene": {"preset": "seven-bar-press", "parameters": parameters},
            "duration": duration,
            "tolerance": tolerance,
            "output_step": 0.01,
        }
    )
    scene = Scene.model_validate(admission.scene)
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


def ten_revolutions(kernel: Kernel, problems: list[LaneProblem]) -> float:
    """Return the best seconds a revolution and lane over ten revolutions, eight lanes busy."""
    best = float("inf")
    for _ in range(8):
        bundle = Bundle(kernel, problems)
        begun = time.perf_counter()
        while bundle.advance(10_000_000):
            pass
        best = min(best, time.perf_counter() - begun)
    return best / (10 * len(problems))


def state_at_check(kernel: Kernel, tolerance: float) -> np.ndarray:
    """Return coordinates and speeds at 0.03 s."""
    bundle = Bundle(kernel, [problem(5e-4, tolerance, CHECK_TIME)])
    bundle.advance(10_000_000)
    return bundle.table("y0", kernel.states)[:, 0].copy()


def main() -> None:
    """Print times and errors by tolerance."""
    kernel = compiled()
    reference = state_at_check(kernel, 1e-13)
    half = kernel.states // 2
    print("tolerance  alone: best, median   8 lanes: best, median     steps   error at 0.03 s")
    print("             ms a revolution       ms a revolution, lane           position  velocity")
    lanes = [float(c) for c in np.linspace(3e-4, 6e-4, 8)]
    for tolerance in (1e-5, 1e-6, 1e-8, 1e-10):
        alone, bundle = timed(kernel, [problem(5e-4, tolerance, 2.0)])
        together, _ = timed(kernel, [problem(c, tolerance, 2.0) for c in lanes])
        error = np.abs(state_at_check(kernel, tolerance) - reference)
        steps = bundle.table("steps")[0, 0] + bundle.counters[Counter.REJECTIONS, 0]
        print(
            f"{tolerance:8.0e} {1e3 * min(alone):11.2f} {1e3 * statistics.median(alone):7.2f}"
            f" {125 * min(together):15.2f} {125 * statistics.median(together):7.2f}"
            f" {steps:13.0f} {error[:half].max():11.1e} {error[half:].max():9.1e}"
        )
    long = ten_revolutions(kernel, [problem(c, 1e-6, 20.0) for c in lanes])
    print(f"over ten revolutions, 8 lanes, 1e-6: {1e3 * long:.2f} ms a revolution and lane")


if __name__ == "__main__":
    main()
