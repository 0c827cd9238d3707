"""The kind ``continuation``: periodic orbits followed over a parameter, stable or not."""

from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, Literal

import numpy as np
from pydantic import Field

from jointplay.records.failure import InvalidInput, Problem
from jointplay.solver.continuation.columns import columns_of
from jointplay.solver.continuation.plan import OUTPUTS, ContinuationStudy, Reach
from jointplay.solver.kinds import documents
from jointplay.solver.kinds.checked_points import check_points
from jointplay.solver.kinds.job import Job
from jointplay.solver.kinds.kind import Kind
from jointplay.solver.kinds.limits import check_size
from jointplay.solver.kinds.methods import check_study
from jointplay.solver.kinds.periods import Periods, periods
from jointplay.solver.kinds.points import Axis, Points, one_axis
from jointplay.solver.kinds.section import CrankSection
from jointplay.solver.kinds.section_checks import check_section
from jointplay.solver.kinds.start_state import StartState, check_state
from jointplay.solver.kinds.studies import Kept, PlacedPoints, Spans, make_study, place_points
from jointplay.solver.kinds.values import Range
from jointplay.solver.quantities.units import Name, quantity
from jointplay.solver.runs.study.plan import Study
from jointplay.solver.statistics import Output

USUAL_TOLERANCE = 1e-11
RECORD = 4
"""Orbits of a branch at most, in those that it may have in each direction."""
MAPS = 8
"""Section maps that an orbit takes, about: rounds of Newton's method, errors, special orbits."""


class ContinuationJob(Job):
    """A branch of periodic orbits, stable or not, with its bifurcations."""

    kind: Literal["continuation"]
    parameter: Annotated[Name, Field(description="a declared parameter of the scene")]
    values: Annotated[
        Range,
        Field(
            description=(
                "its range, and how many orbits a branch may have in each direction: {'from', 'to',"
                " 'count'}"
            )
        ),
    ]
    at: Annotated[
        float | None,
        quantity(
            "the parameter's unit",
            description="value at which the branch begins; default: the first of the range",
        ),
    ] = None
    period: Annotated[
        int,
        quantity("periods", ge=1, le=64, description="of the drivers, after which orbits are back"),
    ] = 1
    settle: Annotated[
        int,
        quantity(
            "periods", ge=0, le=10**12, description="of motion before an orbit is sought from it"
        ),
    ] = 100
    state: StartState = None
    largest_step: Annotated[
        float,
        quantity(
            "1", ge=1e-4, le=0.5, description="largest step along a branch, a share of the range"
        ),
    ] = 0.03
    doublings: Annotated[
        int,
        quantity(
            "1", ge=0, le=6, description="period doublings behind which branches are followed, too"
        ),
    ] = 0

    record: Annotated[
        int | None,
        quantity(
            "1",
            ge=2,
            le=10**12,
            description=(
                "orbits of a branch at most, special ones counted; default: four times the count"
            ),
        ),
    ] = None

    @property
    def usual_tolerance(self) -> float:
        """Tolerance where none is given: derivatives are differences of runs."""
        return USUAL_TOLERANCE


class Continuation(Kind[ContinuationJob]):
    """A point for each branch, all in one block: each begins where the one before doubles."""

    document = ContinuationJob
    results: ClassVar = ("points", "branch", "poincare", "figures", "zarr")
    option: ClassVar = "branch"

    def admit(self, job: ContinuationJob) -> ContinuationStudy:
        """Check and fill in; see `Kind.admit`."""
        check_study(job, tangents=False)
        _check_range(job)
        checked = check_points(job, _range(job))
        units = periods(checked.scenes)
        check_section(CrankSection(), checked, units)
        if checked.structure.any():
            sentence = "The mechanism's equations change their form within the range; narrow it."
            raise InvalidInput.at("/values", sentence)
        found = {
            "at": job.values.start if job.at is None else job.at,
            "record": job.record or RECORD * job.values.count,
        }
        filled = documents.filled(job, checked.document, checked.echo, **found)
        placed = place_points(job, _branches(job))
        study = _study(job, filled, placed, periods(placed.scenes))
        check_state(job.state, study.point_scene(0), job.formulation)
        longest = job.period * 2**job.doublings
        states = sum(c.name.startswith(("state.", "rate.")) for c in study.observables)
        runs = 2 * job.values.count * MAPS * (2 * states + 3)
        check_size(study, job.settle + runs * longest, "/values/count")
        return study

    def plan(self, job: ContinuationJob, filled: dict[str, Any]) -> ContinuationStudy:
        """Return what `admit` returned; see `Kind.plan`."""
        placed = place_points(job, _branches(job))
        return _study(job, filled, placed, periods(placed.scenes))

    def outputs(self, study: Study) -> Mapping[str, Output]:
        """Return counts of orbits and of special ones."""
        return OUTPUTS


def _check_range(job: ContinuationJob) -> None:
    low, high = sorted((job.values.start, job.values.stop))
    problems = []
    if low == high:
        problems.append(Problem("/values/to", "The range is empty; 'to' must differ from 'from'."))
    if job.values.spacing != "linear":
        sentence = "A branch chooses its own steps; leave 'spacing' out."
        problems.append(Problem("/values/spacing", sentence))
    if job.at is not None and not low <= job.at <= high:
        sentence = f"'at' must lie in the range, {low:g} to {high:g}; it is {job.at:g}."
        problems.append(Problem("/at", sentence))
    if job.formulation != "reduced":
        sentence = "Sections are joint coordinates, which only the formulation 'reduced' has."
        problems.append(Problem("/formulation", f"{sentence} Choose that."))
    if problems:
        raise InvalidInput(problems)


def _range(job: ContinuationJob) -> Points:
    """Return both ends of the range and the start as points, to be checked."""
    at = job.values.start if job.at is None else job.at
    places = ("/values/from", "/values/to", "/values/from" if job.at is None else "/at")
    values = np.array([job.values.start, job.values.stop, at])
    return one_axis(Axis(job.parameter, "/parameter", values, places.__getitem__))


def _branches(job: ContinuationJob) -> Points:
    """Return a point for each branch, at the value where the first one begins."""
    at = job.values.start if job.at is None else job.at
    values = np.full(job.doublings + 1, at)
    return one_axis(Axis(job.parameter, "/parameter", values, lambda _point: "/at"))


def _study(
    job: ContinuationJob, filled: dict[str, Any], placed: PlacedPoints, units: Periods
) -> ContinuationStudy:
    count = placed.points.count
    unit = placed.declared.parameters[job.parameter].unit
    columns = columns_of(placed.scenes.scene(0), job.parameter, unit)
    kept = Kept(observables=columns, record=filled["record"])
    settle = job.settle * units.seconds
    spans = Spans(units.seconds, settle, settle + job.period * units.seconds)
    study = make_study(filled, placed, spans, kept)
    low, high = sorted((job.values.start, job.values.stop))
    own = {"blocks": ((0, count),)}
    return ContinuationStudy(
        **(vars(study) | own),
        start=filled["at"],
        reach=Reach(low, high, job.values.count, job.largest_step),
    )
