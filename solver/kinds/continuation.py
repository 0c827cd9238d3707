"""The kind ``continuation``: periodic orbits followed over a parameter, stable or not."""

from collections.abc import Iterable, Mapping
from typing import Any, ClassVar

import numpy as np

from jointplay.records.failure import InvalidInput
from jointplay.records.suggestions import unknown
from jointplay.solver.continuation.columns import columns_of
from jointplay.solver.continuation.plan import (
    OUTPUTS,
    SECTIONS,
    TRIES,
    ContinuationStudy,
    Reach,
    Second,
)
from jointplay.solver.kinds import documents
from jointplay.solver.kinds.checked_points import check_points
from jointplay.solver.kinds.continuation_checks import check_ranges, check_sections
from jointplay.solver.kinds.continuation_job import AlongSecond, ContinuationJob
from jointplay.solver.kinds.limits import check_size
from jointplay.solver.kinds.mechanism import written
from jointplay.solver.kinds.methods import check_study
from jointplay.solver.kinds.observables import chosen, coordinate_channels
from jointplay.solver.kinds.periods import Periods, periods
from jointplay.solver.kinds.points import Axis, Points, one_axis, product
from jointplay.solver.kinds.start_state import check_state
from jointplay.solver.kinds.studies import Kept, PlacedPoints, Spans, StudyKind, make_study
from jointplay.solver.kinds.values import Range
from jointplay.solver.runs.study.plan import Study
from jointplay.solver.scene.parameters import set_parameters
from jointplay.solver.statistics import Output

RECORD = 4
"""Orbits of a branch at most, in those that it may have in each direction."""
MAPS = 8
"""Section maps that an orbit takes, about: rounds of Newton's method, errors, special orbits."""


class Continuation(StudyKind[ContinuationJob]):
    """A point for each branch, all in one block: one begins where another doubles or branches."""

    document = ContinuationJob
    results: ClassVar = ("points", "branch", "poincare", "figures", "zarr")
    option: ClassVar = "branch"

    def admit(self, job: ContinuationJob) -> Study:
        """Check and fill in; see `Kind.admit`."""
        check_study(job, tangents=False)
        check_ranges(job)
        checked = _checked(job, one_axis(_first_axis(job)), "/values")
        if job.second is not None:
            checked = _checked(job, _both(job, job.second), "/second/values")
        default = coordinate_channels(checked)
        observed = chosen(checked, job.observables, default, "/observables")
        found = {
            "observables": [channel.name for channel in observed],
            "at": job.values.start if job.at is None else job.at,
            "record": job.record or RECORD * job.values.count,
        }
        filled = documents.filled(job, checked.document, checked.echo, **found)
        study = self.plan(job, filled)
        check_state(job.state, study.point_scene(0), job.formulation)
        longest = job.period * 2**job.doublings
        states = sum(c.name.startswith(("state.", "rate.")) for c in study.observables)
        each = MAPS * (2 * states + 3)
        runs = 2 * job.values.count * each
        settle = job.settle
        if job.orbits > 1:
            settle += SECTIONS + TRIES * job.orbits * each * job.period
        check_size(study, settle + runs * longest, "/values/count")
        if job.second is not None:
            runs += 2 * job.second.values.count * job.second.curves * MAPS * (10 * states + 5)
            check_size(study, settle + runs * longest, "/second/values/count")
        return study

    def points(self, job: ContinuationJob) -> Points:
        """Return a point for each branch and curve, where the first one begins."""
        at = job.values.start if job.at is None else job.at
        count = job.orbits + job.doublings + job.branch_points
        count += job.second.curves if job.second else 0
        axes = [Axis(job.parameter, "/parameter", np.array([at]), lambda _index: "/at")]
        if job.second is not None:
            values, pointer = np.array([_second_start(job, job.second)]), "/second/parameter"
            named = job.second.parameter
            axes.append(Axis(named, pointer, values, lambda _index: "/second/values"))
        return Points(tuple(axes), np.zeros((count, len(axes)), np.int64), lambda _point: "/at")

    def study(
        self, job: ContinuationJob, filled: dict[str, Any], placed: PlacedPoints, units: Periods
    ) -> ContinuationStudy:
        """Return the study; see `StudyKind.study`."""
        parameters = placed.points.parameters
        units_of = [placed.declared.parameters[name].unit for name in parameters]
        driven = job.section is None
        columns = columns_of(placed.scenes.scene(0), parameters, units_of, driven=driven)
        columns += placed.channels(filled["observables"])
        settle = job.settle * units.seconds
        spans = Spans(units.seconds, settle, settle + job.period * units.seconds)
        kept = Kept(observables=columns, record=filled["record"])
        own = vars(make_study(filled, placed, spans, kept))
        return ContinuationStudy(
            **(own | {"blocks": ((0, placed.points.count),)}),
            start=filled["at"],
            reach=_reach(job, job.values),
            doublings=job.doublings,
            orbits=job.orbits,
            second=None if job.second is None else _second(job, job.second, placed),
        )

    def varied(self, job: ContinuationJob, study: Study) -> Iterable[str]:
        """Return the first parameter; the scene's value of a second one is where it begins."""
        return (job.parameter,)

    def outputs(self, study: Study) -> Mapping[str, Output]:
        """Return counts of orbits and of special ones."""
        return OUTPUTS


def _checked(job: ContinuationJob, points: Points, pointer: str) -> PlacedPoints:
    """Return the ends of ranges once there is a section at each, and the equations are the same."""
    checked = check_points(job, points)
    check_sections(job, checked, periods(checked.scenes))
    if checked.structure.any():
        sentence = "The mechanism's equations change their form within the range; narrow it."
        raise InvalidInput.at(pointer, sentence)
    return checked


def _first_axis(job: ContinuationJob) -> Axis:
    """Return both ends of the range and the start."""
    at = job.values.start if job.at is None else job.at
    return _axis(job.parameter, job.values, at, "", "/values/from" if job.at is None else "/at")


def _both(job: ContinuationJob, second: AlongSecond) -> Points:
    """Return the corners of both ranges, and where a branch begins, as points."""
    pointer, values = "/second/values", second.values
    begin = _second_start(job, second)
    low, high = sorted((values.start, values.stop))
    if not low <= begin <= high:
        sentence = f"The range must include {begin:g}, the scene's '{second.parameter}'."
        raise InvalidInput.at(pointer, sentence)
    axis = _axis(second.parameter, values, begin, "/second", pointer)
    return product([_first_axis(job), axis], pointer)


def _axis(parameter: str, values: Range, begin: float, part: str, pointer: str) -> Axis:
    """Return the ends of a range, and where a branch begins, as an axis."""
    pointers = (f"{part}/values/from", f"{part}/values/to", pointer)
    ends = np.array([values.start, values.stop, begin])
    return Axis(parameter, f"{part}/parameter", ends, pointers.__getitem__)


def _second_start(job: ContinuationJob, second: AlongSecond) -> float:
    """Return the second parameter's value in the scene.

    InvalidInput: the scene does not declare it, or it has no number.
    """
    document, scene, given = written(job)
    if second.parameter not in scene.parameters:
        sentence = unknown("parameter", second.parameter, scene.parameters)
        raise InvalidInput.at("/second/parameter", sentence)
    value = set_parameters(document, scene, given, (job.parameter,))[1][second.parameter]
    if not isinstance(value, float):
        sentence = f"'{second.parameter}' has no number in the scene; give it one there."
        raise InvalidInput.at("/second/parameter", sentence)
    return value


def _reach(
    job: ContinuationJob, values: Range, first: tuple[tuple[float, float], ...] = ()
) -> Reach:
    low, high = sorted((values.start, values.stop))
    return Reach(low, high, values.count, job.largest_step, first)


def _second(job: ContinuationJob, second: AlongSecond, placed: PlacedPoints) -> Second:
    low, high = sorted((job.values.start, job.values.stop))
    begin = float(placed.points.values()[0, 1])
    reach = _reach(job, second.values, ((low, high),))
    return Second(begin, reach, tuple(second.labels), second.curves)
