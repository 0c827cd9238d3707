"""The work-precision study of a scene: its reference, its window, and every run against it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from solver.admission import Admission
from solver.integrators import METHODS
from solver.trade.runs import SAMPLES, Passed, pass_through

Floats = NDArray[np.float64]

REFERENCE = 1e-13
"""Tolerance of the two reference runs, of the two methods of highest order."""
KNOWN = 1e-8
"""Runs are compared as long as the references differ by less, relative to the scene's scales."""
TOLERANCES = (1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11)
GRID = 1e-4
"""Longest fixed step, of a period: the 0.2 ms grid on a press that turns in 2 s."""
FINER = (1, 2, 4, 10, 20, 40)
MOST_ASTRAY = 0.05
"""Share of energy astray on which `largest_tolerance` of methods rests."""
PATIENCE = 10.0
"""Seconds that a run may take; tighter ones of the same method would take longer still."""


@dataclass(frozen=True)
class Point:
    """A method at a tolerance, or with a step: its cost and its error.

    `error` : root mean square over the window and the coordinates and speeds, each relative to the
    scale that tolerances are relative to; none where the run did not come to the end.
    `astray` : energy lost track of, as a share of what contacts and friction took.
    """

    method: str
    tolerance: float | None
    step: float | None
    error: float | None
    astray: float | None
    steps: int
    evaluations: int
    seconds: float
    admitted: bool


@dataclass(frozen=True)
class Trade:
    """A work-precision study.

    `window` : s from the start in which the reference is known. `uncertainty` : how far the two
    references are apart there; smaller errors mean nothing.
    """

    duration: float
    window: float
    uncertainty: float
    points: tuple[Point, ...]

    def document(self) -> dict[str, Any]:
        """Return the study as JSON would have it."""
        return asdict(self)


def measure(admission: Admission, report: Callable[[float, str], None]) -> Trade:
    """Run every method at every tolerance; `report` is told the fraction done and what is next."""
    report(0.0, "reference runs")
    reference = pass_through(admission, "dormand-prince-853", REFERENCE)
    other = pass_through(admission, "tsitouras", REFERENCE)
    count = min(len(reference.states), len(other.states))
    apart = np.abs(reference.states[:count] - other.states[:count]) / reference.scales
    unknown = np.flatnonzero(apart.max(axis=1) > KNOWN)
    known = int(unknown[0]) if len(unknown) else count
    uncertainty = _mean_error(reference, other, known)
    planned = list(_planned(admission))
    points: list[Point] = []
    given_up: set[str] = set()
    for index, (method, tolerance, step) in enumerate(planned):
        if method in given_up:
            continue
        report(index / len(planned), f"{method} {tolerance or step:g}")
        best = pass_through(admission, method, tolerance or 1.0, step=step, patience=PATIENCE)
        if best.seconds > PATIENCE:
            if tolerance is None or tolerance <= METHODS[method].largest_tolerance:
                given_up.add(method)
            continue
        points.append(_point(method, tolerance, step, best, reference, known))
    return Trade(
        float(admission.job["duration"]),
        float(reference.time[known - 1]),
        uncertainty,
        tuple(points),
    )


def _planned(admission: Admission) -> Iterator[tuple[str, float | None, float | None]]:
    unit = admission.period or float(admission.job["duration"])
    for name, tableau in METHODS.items():
        if tableau.error:
            yield from ((name, tolerance, None) for tolerance in TOLERANCES)
        else:
            yield from ((name, None, GRID * unit / finer) for finer in FINER)


def _point(
    method: str,
    tolerance: float | None,
    step: float | None,
    run: Passed,
    reference: Passed,
    known: int,
) -> Point:
    whole = run.complete and len(run.states) == SAMPLES + 1 and bool(np.isfinite(run.states).all())
    limit = METHODS[method].largest_tolerance
    return Point(
        method,
        tolerance,
        step,
        _mean_error(run, reference, known) if whole else None,
        run.astray if whole and np.isfinite(run.astray) else None,
        run.steps,
        run.evaluations,
        run.seconds,
        tolerance is None or tolerance <= limit,
    )


def _mean_error(run: Passed, reference: Passed, known: int) -> float:
    error = (run.states[:known] - reference.states[:known]) / reference.scales
    return float(np.sqrt(np.mean(error**2)))
