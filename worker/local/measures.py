"""Measures of candidates by several processes, whose number changes no value."""

import json
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import lru_cache, partial

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.calibration.measure import Measure, Measurement
from jointplay.solver.calibration.problem import Calibration
from jointplay.solver.kernels.layout import BUNDLE
from jointplay.solver.kinds import admit_calibration
from jointplay.solver.runs.processes import Advance, Call, Interrupted, Processes, processes


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
