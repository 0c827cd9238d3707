"""The same ways as the product's, of the press in C++."""

import time
from functools import partial

import numpy as np
from numpy.typing import NDArray

from benchmarks.limit.numbers import mechanism, presses
from benchmarks.limit.product import BUNDLE, ENDLESS, SETTLING, STEADY, Case, Measured, Way
from benchmarks.limit.program import Program


def _measured(
    before: NDArray[np.void], now: NDArray[np.void], begun: float, period: float
) -> Measured:
    seconds = time.process_time() - begun
    steps = float((now["accepted"] - before["accepted"]).sum())
    return Measured(seconds, steps, float((now["time"] - before["time"]).sum()) / period)


def limit_ways(case: Case, wide: Program, scalar: Program) -> dict[str, Way]:
    """Return the ways that the program has, by the names that the product's have."""
    kernel = case.kernel()
    problems = case.problems()
    common, first = mechanism(problems[0].scene), presses(kernel, problems)
    every = len(first) // BUNDLE
    lasting = presses(kernel, case.problems(every, ENDLESS))
    groups = [lasting[i : i + wide.width] for i in range(0, BUNDLE, wide.width)]
    for group in groups:
        wide.advance(common, group, SETTLING)

    def from_start(program: Program, runs: NDArray[np.void]) -> Measured:
        now = runs.copy()
        begun = time.process_time()
        program.advance(common, now)
        return _measured(runs, now, begun, case.period)

    def steady() -> Measured:
        before = lasting.copy()
        begun = time.process_time()
        for group in groups:
            wide.advance(common, group, STEADY)
        return _measured(before, lasting, begun, case.period)

    return {
        "study": partial(from_start, wide, first),
        "steady": steady,
        "alone": partial(from_start, scalar, first[::every].copy()),
    }
