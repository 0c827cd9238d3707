"""Kernels beside what the machine could do.

    python -m benchmarks limit [--lanes 4,8] [--turns 15] [--beside WHEEL]

The press in C++, scalar and in lanes, written for this comparison and built with the compiler that
is found, beside the product in one run: all take turns on one processor, processor time counts,
ratios are medians of those of the turns, with their quartiles.  C++ computes the motion and nothing
else; in a second program of it sines are exact to rounding, as in the product.  With the wheel of
an earlier version both versions run one text, for the press and for the slider-crank.
"""

import argparse
import os
import tempfile
from collections.abc import Mapping
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from benchmarks.limit.cases import PRESS, SLIDER_CRANK
from benchmarks.limit.limit_ways import limit_ways
from benchmarks.limit.numbers import mechanism, presses
from benchmarks.limit.product import Case, Way
from benchmarks.limit.program import WIDTHS, Program, compiler
from benchmarks.limit.table import EXACT, PRODUCT, WHEEL, C, table
from benchmarks.limit.turns import Samples, install, product, take_turns
from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import LaneProblem

CHECKED = 0.03
"""Time at which states are compared, s: after nine onsets."""
TOLERANCES, TRUE = (1e-6, 1e-8, 1e-10), 1e-13


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks limit")
    parser.add_argument("--lanes", default="4,8", help="widths of kernels, of 4 and 8")
    parser.add_argument("--turns", type=int, default=15)
    parser.add_argument("--beside", type=Path, metavar="WHEEL", help="an earlier version")
    options = parser.parse_args()
    stay_on_one_processor()
    load = os.getloadavg()[0]
    print(
        f"load of the machine {load:.1f} on {os.cpu_count()} cores; C++ by {compiler() or 'nobody'}"
    )
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        programs: dict[int, Program] = {}
        if compiler() is None:
            print("C++ is skipped: there is no compiler; install g++ or set CXX.")
        else:
            programs = {width: Program(width, folder) for width in WIDTHS}
            compare(programs)
        wheel = options.beside and install(options.beside, folder / "wheel")
        for lanes in map(int, options.lanes.split(",")):
            limits: dict[str, Mapping[str, Way]] = {}
            if programs:
                exact = [Program(width, folder, exact=True) for width in (lanes, 1)]
                limits = {
                    C: limit_ways(PRESS, programs[lanes], programs[1]),
                    EXACT: limit_ways(PRESS, *exact),
                }
            measure(PRESS, lanes, limits, wheel, options.turns)
            if wheel:
                measure(SLIDER_CRANK, lanes, {}, wheel, options.turns)


def stay_on_one_processor() -> None:
    """Have this process and those that it starts run on one processor: each has its own clock.

    On a shared machine clocks change by a third from one second to the next, and not together.
    """
    if hasattr(os, "sched_setaffinity"):  # on Linux alone
        os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})


def compare(programs: Mapping[int, Program]) -> None:
    """Print errors of states at `CHECKED` against the product's own at `TRUE`, and steps."""
    print(f"\nthe press at {CHECKED} s: errors, m or rad and a second; accepted steps")
    kernel = PRESS.kernel()
    truth = _state(kernel, _problem(TRUE))[0]
    for tolerance in TOLERANCES:
        problem = _problem(tolerance)
        found = {"product": _state(kernel, problem)}
        for width, program in programs.items():
            [run] = runs = presses(kernel, [problem])
            program.advance(mechanism(problem.scene), runs)
            found[f"C++, {width} side by side"] = run["y"], int(run["accepted"])
        for who, (state, taken) in found.items():
            position, speed = (np.abs(half).max() for half in np.split(state - truth, 2))
            print(f"{tolerance:.0e}  {who:<22}{position:9.1e}{speed:9.1e}{taken:7d}")


def _problem(tolerance: float) -> LaneProblem:
    case = replace(PRESS, tolerance=tolerance)
    return case.problems(len(case.parameters), CHECKED / case.period)[0]


def _state(kernel: Kernel, problem: LaneProblem) -> tuple[NDArray[np.float64], int]:
    bundle = Bundle(kernel, [problem], watch=False)
    bundle.advance(10**9)
    return bundle.lane(0)["y"].copy(), bundle.lane(0).steps


def measure(
    case: Case,
    lanes: int,
    limits: Mapping[str, Mapping[str, Way]],
    wheel: Path | None,
    turns: int,
) -> None:
    """Print the table of a case for kernels of one width."""
    with ExitStack() as stack:
        now = stack.enter_context(product(case, lanes))
        programs = {**limits, PRODUCT: now.ways()}
        print(
            f"\nthe {case.preset}, kernels of {now.lanes} lanes: ms a revolution; ratios of these"
        )
        if wheel is not None:
            earlier = stack.enter_context(product(case, lanes, wheel))
            programs[WHEEL] = earlier.ways()
            print(f"product {now.version}; wheel {earlier.version}, {earlier.lanes} lanes")
            for way, reason in earlier.lacking.items():
                print(f"the wheel lacks '{way}': {reason}")
        samples = take_turns(programs, turns)
    print(*table(samples), steps(samples), sep="\n")


def steps(samples: Samples) -> str:
    """Return a line that tells how many steps a revolution takes."""
    counted = []
    for who, ways in samples.items():
        for way in ("study", "steady"):
            if ways.get(way):
                each = np.median([one.steps / one.periods for one in ways[way]])
                counted.append(f"{who} {each:.0f} ({way})")
    return f"accepted steps a revolution: {', '.join(counted)}"
