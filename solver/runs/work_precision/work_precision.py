"""Findings of an accuracy-study: its runs, and the sentence that recommends one."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from jointplay.solver.runs.work_precision.advice import advice
from jointplay.solver.runs.work_precision.point import Point

Floats = NDArray[np.float64]


class Found(Protocol):
    """A stored study, as far as it is read here; a reader of its store is one."""

    @property
    def attributes(self) -> Mapping[str, Any]:
        """At least "job" and "runs", what each point stands for."""
        ...

    @property
    def complete(self) -> bool:
        """Every run has ended."""
        ...

    @property
    def statistics(self) -> Mapping[str, Floats]:
        """(points,) by the names of `solver.runs.work_precision.plan.OUTPUTS`, and "steps"."""
        ...

    @property
    def failures(self) -> Mapping[int, Any]:
        """By point, why a run did not come to its end, each with a sentence `detail`."""
        ...


@dataclass(frozen=True)
class WorkPrecision:
    """A work-precision study as far as it has come.

    `window` : s from the start in which the reference is known; `uncertainty` : how far the two
    references are apart there, smaller errors mean nothing. None before both have ended.
    """

    complete: bool
    duration: float
    window: float | None
    uncertainty: float | None
    points: tuple[Point, ...]
    """The runs that were computed, without the references."""

    @classmethod
    def of(cls, found: Found) -> WorkPrecision:
        """Return the study that a store holds."""
        runs, columns = found.attributes["runs"], found.statistics

        def number(name: str, point: int) -> float | None:
            value = columns[name][point] if name in columns else math.nan
            return float(value) if math.isfinite(value) else None

        points = [
            Point(
                run["method"],
                run["tolerance"],
                run["step"],
                run["admitted"],
                number("error", point),
                number("astray", point),
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
        sentence = advice(self.points, self.uncertainty or 0.0) if self.complete else None
        return asdict(self) | {"points": [asdict(one) for one in self.points], "advice": sentence}
