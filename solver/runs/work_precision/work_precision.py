"""Findings of an accuracy-study: its runs, and the sentence that recommends one."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass
from typing import Any

from jointplay.records.energy_residual import relative_energy_residuals
from jointplay.records.study import StudySource
from jointplay.solver.runs.work_precision.plan import DEFAULT


@dataclass(frozen=True)
class Point:
    """A method at a tolerance, or with a step (s): its cost and its error.

    `admitted` : whether jobs may ask for it. `error` : root mean square over the window and the
    coordinates and speeds, each relative to the scale that tolerances are relative to; none where
    the run did not come to its end, which `failure` then explains. `relative_energy_residual` :
    what the energy balance lacks, divided by what contacts and friction took; none of nothing.
    `seconds` : of computing; of everything here they alone differ when the study is repeated.
    """

    method: str
    tolerance: float | None
    step: float | None
    admitted: bool
    error: float | None
    relative_energy_residual: float | None
    steps: int
    evaluations: int
    seconds: float
    failure: str | None

    @property
    def name(self) -> str:
        """Method and tolerance or step, as a job asks for them."""
        if self.tolerance is None:
            return f"{self.method} in steps of {self.step:g} s"
        return f"{self.method} at {self.tolerance:.0e}"


def cheapest(points: Iterable[Point], error: float) -> Point | None:
    """Return the admitted run of fewest evaluations whose error is at most `error`."""
    able = [p for p in points if p.admitted and p.error is not None and p.error <= error]
    return min(able, key=lambda p: p.evaluations, default=None)


def advice(points: Sequence[Point], uncertainty: float | None) -> str:
    """Say what gives the error of the default, and one a hundred times smaller, at least cost.

    `uncertainty` : of the reference; no error below is known, and none at all without it. Seconds
    do not count, so the same study gives the same sentence.
    """
    if uncertainty is None:
        return (
            "The two references agree at no instant but the start, so that no error is known: ask"
            " for a shorter duration."
        )
    default = next((p for p in points if (p.method, p.tolerance) == DEFAULT), None)
    if default is None or default.error is None:
        return "The default did not come to the end of this run; ask for a tighter tolerance."
    if default.error <= uncertainty:
        return "The default is as accurate as the reference: there is nothing to choose."
    best = cheapest(points, default.error) or default
    if best.evaluations == default.evaluations:
        best = default
    first = (
        f"The default, {default.name}, makes an error of {default.error:.1e}"
        f" in {default.evaluations} evaluations"
    )
    if best == default:
        first += ", and nothing does it in fewer."
    else:
        first += f"; {best.name} does with {best.evaluations / default.evaluations:.0%} of them."
    finer = max(0.01 * default.error, 3.0 * uncertainty)
    then = cheapest(points, finer)
    if then is None:
        return first
    ratio = then.evaluations / default.evaluations
    return (
        f"{first} For an error below {finer:.1e} take {then.name}, at {ratio:.1f} times the cost."
    )


@dataclass(frozen=True)
class WorkPrecision:
    """A work-precision study as far as it has come.

    `window` : s from the start in which the reference is known; `uncertainty` : how far the two
    references are apart there, smaller errors mean nothing. None before both have ended;
    the latter also where they agree at the start alone, which is a window of 0 s.
    """

    complete: bool
    duration: float
    window: float | None
    uncertainty: float | None
    points: tuple[Point, ...]
    """The runs that were computed, without the references."""

    @classmethod
    def of(cls, found: StudySource) -> WorkPrecision:
        """Return the study that a store holds."""
        runs, columns = found.attributes["runs"], found.statistics

        residuals = relative_energy_residuals(found)

        def number(name: str, point: int) -> float | None:
            return _finite(columns[name][point]) if name in columns else None

        points = [
            Point(
                run["method"],
                run["tolerance"],
                run["step"],
                run["admitted"],
                number("error", point),
                _finite(residuals[point]),
                int(columns["steps"][point]),
                int(columns["evaluations"][point]),
                float(columns["seconds"][point]),
                found.failures[point].detail if point in found.failures else None,
            )
            for point, run in enumerate(runs)
            if not run["reference"] and number("evaluations", point) is not None
        ]
        last = sum(run["reference"] for run in runs) - 1
        return cls(
            found.complete,
            float(found.attributes["job"]["duration"]),
            number("window", last),
            number("error", last),
            tuple(points),
        )

    def document(self) -> dict[str, Any]:
        """Return the study as JSON has it, with the advice once it is complete."""
        sentence = advice(self.points, self.uncertainty) if self.complete else None
        return asdict(self) | {"points": [asdict(one) for one in self.points], "advice": sentence}


def _finite(value: float) -> float | None:
    """Return a number; none for NaN and infinity."""
    return float(value) if math.isfinite(value) else None
