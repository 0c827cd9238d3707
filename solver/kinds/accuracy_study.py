"""The kind ``accuracy-study``: what every method and tolerance costs and buys."""

from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, Literal

import numpy as np
from pydantic import Field

from jointplay.records.failure import LimitExceeded
from jointplay.solver.integrators import METHODS
from jointplay.solver.kinds import documents
from jointplay.solver.kinds.checked_points import check_points
from jointplay.solver.kinds.job import MechanismJob
from jointplay.solver.kinds.limits import LONGEST_ACCURACY_STUDY
from jointplay.solver.kinds.periods import Periods, periods
from jointplay.solver.kinds.points import Points, one_point
from jointplay.solver.kinds.studies import PlacedPoints, Spans, StudyKind, make_study
from jointplay.solver.quantities.registry import NameIn
from jointplay.solver.quantities.units import quantity
from jointplay.solver.runs.study.plan import Study
from jointplay.solver.runs.work_precision.plan import (
    OUTPUTS,
    WITHOUT_PERIOD,
    WorkPrecisionStudy,
    runs_of,
)
from jointplay.solver.statistics import Output

TOLERANCES = (1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11)


class AccuracyStudyJob(MechanismJob):
    """A work-precision study: each method at each tolerance, against a reference run."""

    kind: Literal["accuracy-study"]
    duration: Annotated[
        float | None,
        quantity(
            "s",
            ge=1e-9,
            le=1e12,
            description="simulated time; default one period of the drivers, 1 s without drivers",
        ),
    ] = None
    methods: Annotated[
        list[Annotated[str, NameIn(METHODS)]],
        Field(
            min_length=1,
            max_length=16,
            description="methods to measure, also where jobs may not ask for them",
            default_factory=lambda: list(METHODS),
            json_schema_extra=lambda schema: schema.update(default=list(METHODS)),
        ),
    ]
    tolerances: Annotated[
        list[Annotated[float, quantity("1", ge=1e-12, le=1e-2)]],
        Field(
            min_length=1,
            max_length=64,
            description="tolerances of the methods with error control; others go over fixed steps",
        ),
    ] = list(TOLERANCES)


class AccuracyStudy(StudyKind[AccuracyStudyJob]):
    """A point for each run, all in one block.

    One worker computes them one after the other, so that their seconds can be compared.
    """

    document = AccuracyStudyJob
    results: ClassVar = ("points", "accuracy", "figures", "zarr")

    def admit(self, job: AccuracyStudyJob) -> WorkPrecisionStudy:
        """Check and fill in; see `Kind.admit`."""
        checked = check_points(job, self.points(job))
        units = periods(checked.scenes)
        unit = _unit(units)
        duration = job.duration or unit
        if duration > LONGEST_ACCURACY_STUDY * unit:
            sentence = (
                f"{duration:g} s are {duration / unit:.3g} periods of {unit:.3g} s; the limit of an"
                f" accuracy-study is {LONGEST_ACCURACY_STUDY} ({LONGEST_ACCURACY_STUDY * unit:.3g}"
                " s). Errors are compared only as long as the reference is known; ask for less."
            )
            raise LimitExceeded.at("/duration", sentence)
        found = {"duration": duration, **_chosen(job)}
        filled = documents.filled(job, checked.document, checked.echo, **found)
        return self.study(job, filled, checked, units)

    def points(self, job: AccuracyStudyJob) -> Points:
        """Return a point for each run."""
        return one_point(len(runs_of(_chosen(job), 1.0)))

    def study(
        self, job: AccuracyStudyJob, filled: dict[str, Any], placed: PlacedPoints, units: Periods
    ) -> WorkPrecisionStudy:
        """Return the study; see `StudyKind.study`."""
        count, period = placed.points.count, _unit(units)
        duration = np.full(count, filled["duration"])
        study = make_study(filled, placed, Spans(np.full(count, period), np.zeros(count), duration))
        own = {"blocks": ((0, count),), "runs": runs_of(filled, period)}
        return WorkPrecisionStudy(**(vars(study) | own))

    def outputs(self, study: Study) -> Mapping[str, Output]:
        """Return costs and errors."""
        return OUTPUTS


def _unit(units: Periods) -> float:
    return WITHOUT_PERIOD if units.notes else float(units.seconds[0])


def _chosen(job: AccuracyStudyJob) -> dict[str, list[Any]]:
    """Return the methods and tolerances of a job, each once and in their order."""
    return {
        "methods": [name for name in METHODS if name in job.methods],
        "tolerances": sorted(set(job.tolerances), reverse=True),
    }
