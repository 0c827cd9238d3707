"""Measured values of candidates in all cases; they do not depend on the number of processes."""

import json
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import lru_cache, partial

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.records.failure import InvalidInput, Problem
from jointplay.solver.calibration.case_measure import CaseMeasure
from jointplay.solver.calibration.problem import Calibration, admit_calibration
from jointplay.solver.kernels.layout import BUNDLE
from jointplay.solver.runs.processes import Advance, Call, Interrupted, Processes, processes

Measure = Callable[[Floats], Floats]
"""Takes candidates (n, parameters), returns the values of all targets (n, targets)."""


class Measurement:
    """Measures candidates in all cases."""

    def __init__(self, calibration: Calibration, *, every: bool) -> None:
        """Look at every target, or only at those that are fitted."""
        self.cases: list[tuple[int, CaseMeasure, list[int]]] = []
        """Index of each case, and where its values stand among all targets."""
        self.count = 0
        for index, case in enumerate(calibration.cases):
            chosen = [i for i, target in enumerate(case.targets) if every or target.weight > 0.0]
            if chosen:
                columns = [self.count + number for number in chosen]
                self.cases.append((index, CaseMeasure(calibration, case, chosen), columns))
            self.count += len(case.targets)

    def prepare(self) -> None:
        """Compile what the first candidates need, and refuse what cannot be measured.

        Raises
        ------
        InvalidInput
            A channel that drivers prescribe.
        LimitExceeded
            The scene's equations are too long to compile.
        """
        problems = [
            Problem(f"/cases/{index}{problem.pointer}", problem.detail)
            for index, case, _ in self.cases
            for problem in case.prepare()
        ]
        if problems:
            raise InvalidInput(problems)

    def __call__(self, candidates: Floats) -> Floats:
        """Return (n, targets): NaN where a run failed or a target is not looked at."""
        out = np.full((len(candidates), self.count), np.nan)
        for _, case, columns in self.cases:
            out[:, columns] = case(candidates)
        return out


@contextmanager
def measures(
    calibration: Calibration, count: int, asked_to_end: Callable[[], bool] = lambda: False
) -> Iterator[tuple[Measure, Measure]]:
    """Give what measures the fitted targets, and what measures every target, by `count` processes.

    Both raise `solver.runs.processes.Interrupted` once the end was asked for.

    Raises
    ------
    InvalidInput
        A target that no parameter can move.
    LimitExceeded
        The scene's equations are too long to compile.
    """
    fitted, every = (Measurement(calibration, every=every) for every in (False, True))
    every.prepare()  # compiles what the processes then find in the cache
    if count == 1:
        yield _unless(asked_to_end, fitted), _unless(asked_to_end, every)
        return
    with processes(count, count, asked_to_end) as pool:
        document = json.dumps(calibration.document)
        dealt = partial(_dealt, pool, count, document)
        yield partial(dealt, False), partial(dealt, True)


def _unless(asked_to_end: Callable[[], bool], measure: Measure) -> Measure:
    def measured(candidates: Floats) -> Floats:
        values = measure(candidates)
        if asked_to_end():
            raise Interrupted
        return values

    return measured


def _dealt(pool: Processes, count: int, document: str, every: bool, candidates: Floats) -> Floats:
    """Measure candidates by several processes, whole bundles of lanes each."""
    parts = min(count, -(-len(candidates) // BUNDLE))
    shares = np.array_split(candidates, max(parts, 1))
    return np.concatenate(pool.make([Call(_measure, (document, every, one)) for one in shares]))


@lru_cache
def _measurement(document: str, every: bool) -> Measurement:
    return Measurement(admit_calibration(json.loads(document)), every=every)


def _measure(document: str, every: bool, candidates: Floats, advance: Advance) -> Floats:
    return _measurement(document, every)(candidates)
