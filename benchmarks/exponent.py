"""Cost of a Lyapunov exponent: presses with tangent vectors against the evaluations they need.

Eight clearances, ten revolutions, tolerance 1e-6, no extremes sought. The evaluations alone are
as many calls of the compiled equations, and of their derivatives, as the run makes. All times are
processor times, the best of repeated runs.
"""

import time
from dataclasses import replace
from typing import Any

import numpy as np
from numba import njit

from benchmarks.press import compiled, problem
from jointplay.solver.kernels.emit.functions import (
    DTYPE,
    OVER_LANES,
    address_of,
)
from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.kernels.emit.tangents import Tangents, compile_tangents
from jointplay.solver.kernels.loop import generated
from jointplay.solver.lanes.bundle import Bundle

REVOLUTIONS = 10
STAGES = 6
"""Evaluations of a step: of the equations, and of their derivative."""
REPEATS = 15


@njit
def repeat(addresses: Any, work: Any, count: int) -> None:
    """Call a lane function many times."""
    for _ in range(count):
        generated.observe(addresses[0], work)


def seconds_of(function: Any, bundle: Bundle, count: int) -> float:
    """Return the seconds of `count` calls of a lane function, the best of repeated tenths."""
    addresses, seconds = np.zeros(1, DTYPE), []
    addresses["observe"] = address_of(function, OVER_LANES)
    for _ in range(REPEATS):
        begun = time.thread_time()
        repeat(addresses, bundle.groups[0].work, count // 10)
        seconds.append(time.thread_time() - begun)
    return 10.0 * min(seconds)


def runs(kernel: Kernel, tangents: Tangents | None) -> tuple[float, Bundle]:
    """Return the seconds of the fastest of repeated runs of eight presses, and its lanes."""
    clearances = [float(c) for c in np.linspace(3e-4, 6e-4, 8)]
    problems = [
        replace(problem(c, 1e-6, 2.0 * REVOLUTIONS), samples=0, sections=0) for c in clearances
    ]
    seconds = []
    for _ in range(REPEATS):
        bundle = Bundle(kernel, problems, watch=False, tangents=tangents)
        begun = time.thread_time()
        while bundle.advance(10_000_000):
            pass
        seconds.append(time.thread_time() - begun)
    return min(seconds), bundle


def main() -> None:
    """Print times and their ratios."""
    kernel = compiled()
    tangents = compile_tangents(kernel)
    plain, _ = runs(kernel, None)
    carried, bundle = runs(kernel, tangents)
    count = STAGES * bundle.attempts
    equations = seconds_of(kernel.module.right_hand_side, bundle, count)
    derivatives = seconds_of(tangents.module.carried_slopes, bundle, count)
    per = 1e3 / (8 * REVOLUTIONS)
    print("                                       ms a revolution and lane")
    print(f"evaluations of the equations alone     {per * equations:8.3f}")
    print(f"evaluations of the derivatives alone   {per * derivatives:8.3f}")
    print(f"run                                    {per * plain:8.3f}")
    print(f"run with tangent vectors               {per * carried:8.3f}")
    print(f"what tangents add, of their evaluations      {(carried - plain) / derivatives:.2f}")
    print(f"with them, of run and their evaluations      {carried / (plain + derivatives):.2f}")
    print(f"with them, of all evaluations                {carried / (equations + derivatives):.2f}")


if __name__ == "__main__":
    main()
