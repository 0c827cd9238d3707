"""Candidates measured by several processes; what they give does not depend on how many."""

from __future__ import annotations

import multiprocessing
import os
import signal
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from typing import Any

import numpy as np
from numpy.typing import NDArray

from jointplay.solver.calibration.measure import Measure, Measurement
from jointplay.solver.calibration.problem import Calibration, admit_calibration
from jointplay.solver.kernels.layout import LANES

Floats = NDArray[np.float64]


@contextmanager
def measures(calibration: Calibration, processes: int) -> Iterator[tuple[Measure, Measure]]:
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
    if processes == 1:
        yield here[0], here[1]
        return
    context = multiprocessing.get_context("spawn")  # threads of libraries do not survive a fork
    pool = ProcessPoolExecutor(processes, context, _begin, (calibration.document,))
    try:
        yield _Dealt(pool, processes, False), _Dealt(pool, processes, True)
    finally:
        pool.shutdown(wait=False, cancel_futures=True)


def cores() -> int:
    """Return how many cores this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


class _Dealt:
    """A measure whose candidates are dealt out to processes."""

    def __init__(self, pool: ProcessPoolExecutor, processes: int, every: bool) -> None:
        self.pool, self.processes, self.every = pool, processes, every

    def __call__(self, candidates: Floats) -> Floats:
        parts = min(self.processes, -(-len(candidates) // LANES))
        shares = np.array_split(candidates, max(parts, 1))
        return np.concatenate(list(self.pool.map(_measure, shares, [self.every] * len(shares))))


class _Process:
    """What one of the processes measures with: set once when it begins."""

    measurements: dict[bool, Measurement]


def _begin(document: dict[str, Any]) -> None:
    """Prepare a process of the pool; Ctrl-C is for the one that reports."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    calibration = admit_calibration(document)
    _Process.measurements = {
        every: Measurement(calibration, every=every) for every in (False, True)
    }


def _measure(candidates: Floats, every: bool) -> Floats:
    return _Process.measurements[every](candidates)
