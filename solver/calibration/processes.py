"""Candidates measured by several processes; the values do not depend on how many."""

import json
from collections.abc import Iterator
from contextlib import contextmanager
from functools import lru_cache

import numpy as np

from jointplay.solver.calibration.measure import Floats, Measure, Measurement
from jointplay.solver.calibration.problem import Calibration, admit_calibration
from jointplay.solver.kernels.layout import BUNDLE
from jointplay.solver.runs.processes import Advance, Call, Processes, processes


@contextmanager
def measures(calibration: Calibration, count: int) -> Iterator[tuple[Measure, Measure]]:
    """Give what measures the fitted targets, and what measures every target.

    Raises
    ------
    InvalidInput
        A target that no parameter can move.
    LimitExceeded
        The scene's equations are too long to compile.
    """
    here = [Measurement(calibration, every=every) for every in (False, True)]
    here[1].prepare()  # compiles what the processes then find in the cache
    if count == 1:
        yield here[0], here[1]
        return
    with processes(count, most_calls=count) as pool:
        document = json.dumps(calibration.document)
        yield _Dealt(pool, count, document, False), _Dealt(pool, count, document, True)


class _Dealt:
    """A measure whose candidates are dealt out to processes."""

    def __init__(self, pool: Processes, count: int, document: str, every: bool) -> None:
        self.pool, self.count, self.constants = pool, count, (document, every)

    def __call__(self, candidates: Floats) -> Floats:
        parts = min(self.count, -(-len(candidates) // BUNDLE))
        shares = np.array_split(candidates, max(parts, 1))
        calls = [Call(_measure, (*self.constants, share)) for share in shares]
        return np.concatenate(self.pool.make(calls))


@lru_cache
def _measurement(document: str, every: bool) -> Measurement:
    return Measurement(admit_calibration(json.loads(document)), every=every)


def _measure(document: str, every: bool, candidates: Floats, advance: Advance) -> Floats:
    return _measurement(document, every)(candidates)
