"""The kinds whose points are looked at as a whole: extremes and statistics of channels."""

from collections.abc import Mapping
from typing import Annotated, Any, TypeVar

import numpy as np
from pydantic import Field

from jointplay.records.failure import InvalidInput, Problem
from jointplay.solver.kinds import documents
from jointplay.solver.kinds.checked_points import check_points
from jointplay.solver.kinds.job import ChannelChoice, Energies, Job
from jointplay.solver.kinds.limits import check_size
from jointplay.solver.kinds.methods import check_study
from jointplay.solver.kinds.observables import (
    chosen,
    coordinate_channels,
    peak_channels,
    shared_channels,
)
from jointplay.solver.kinds.periods import Periods, periods
from jointplay.solver.kinds.statistics import (
    SamplesPerPeriod,
    StatisticChoice,
    check_samples,
    check_statistics,
    statistic_count,
    statistic_outputs,
)
from jointplay.solver.kinds.studies import Kept, PlacedPoints, Spans, StudyKind, make_study
from jointplay.solver.quantities.units import quantity
from jointplay.solver.runs.study.plan import Study
from jointplay.solver.scene.domains import domain_problems
from jointplay.solver.statistics import Output


class ExtremesStudyJob(Job):
    """A study of peaks and statistics at each point; one of `duration` and `periods`."""

    duration: Annotated[
        float | None, quantity("s", ge=1e-9, le=1e12, description="simulated time")
    ] = None
    periods: Annotated[
        float | None,
        quantity(
            "periods", gt=0.0, le=1e12, description="or simulated time in periods of each point"
        ),
    ] = None
    settle: Annotated[
        float,
        quantity(
            "s or periods",
            ge=0.0,
            le=1e12,
            description=(
                "what comes before does not count in peaks and statistics; in the unit of the"
                " duration"
            ),
        ),
    ] = 0.0
    channels: Annotated[
        ChannelChoice | None,
        Field(
            description=(
                "channels whose peaks and statistics are kept, names or globs; default: the"
                " declared outputs, and normal force and penetration of each joint with clearance"
            )
        ),
    ] = None
    statistics: StatisticChoice = []
    samples_per_period: SamplesPerPeriod = 256
    energies: Energies = True

    @property
    def named_channels(self) -> list[str]:
        """See `MechanismJob.named_channels`."""
        return self.channels or []


J = TypeVar("J", bound=ExtremesStudyJob)


class ExtremesStudy(StudyKind[J]):
    """A kind of extremes and statistics, as `sweep`; a member has its points."""

    def outputs(self, study: Study) -> Mapping[str, Output]:
        """Return the statistics of channels and contacts that the job chose."""
        return statistic_outputs(study)

    def admit(self, job: J) -> Study:
        """Check and fill in; see `Kind.admit`."""
        check_study(job, tangents=False)
        _check_length(job)
        points = self.points(job)
        checked = check_points(job, points)
        offered = {channel.name for channel in shared_channels(checked)}
        peaks = [name for name in peak_channels(checked) if name in offered]
        default = peaks or coordinate_channels(checked)
        channels = chosen(checked, job.channels, default, "/channels")
        units = periods(checked.scenes)
        if job.periods is not None and units.notes:
            raise InvalidInput(
                Problem("/periods", f"{points.name(at, checked.declared)}{note} Give a 'duration'.")
                for at, note in units.notes.items()
            )
        check_statistics(job.statistics, checked.pairs(), len(channels))
        names = [channel.name for channel in channels]
        filled = documents.filled(job, checked.document, checked.echo, channels=names)
        study = self.study(job, filled, checked, units)
        _check_domains(checked, study)
        check_samples(job, study)
        longest = float((study.duration / study.period).max())
        check_size(study, longest, "/periods" if job.periods is not None else "/duration")
        return study

    def study(self, job: J, filled: dict[str, Any], placed: PlacedPoints, units: Periods) -> Study:
        """Return the study; see `StudyKind.study`."""
        unit = units.seconds if job.periods is not None else np.ones(placed.points.count)
        length = job.duration if job.periods is None else job.periods
        channels = placed.channels(filled["channels"])
        statistics = statistic_count(job.statistics, len(channels), len(placed.pairs()))
        spans = Spans(units.seconds, job.settle * unit, (length or 0.0) * unit)
        return make_study(filled, placed, spans, Kept(channels=channels, statistics=statistics))


def _check_domains(placed: PlacedPoints, study: Study) -> None:
    """Refuse what points ask of functions that refuse it: the longest, and those at the ends."""
    columns = [study.duration, *(placed.scenes.column(leaf) for leaf in placed.scenes.leaves)]
    ends = [int(end) for column in columns for end in (np.argmax(column), np.argmin(column))]
    for point in dict.fromkeys(ends):
        problems = domain_problems(placed.scenes.scene(point), float(study.duration[point]))
        named = [Problem(at, f"{placed.beginning(point)}{detail}") for at, detail in problems]
        if named:
            raise InvalidInput(named)


def _check_length(job: ExtremesStudyJob) -> None:
    """Refuse a job that does not say once how long each point runs, or settles for all of it."""
    given = [length for length in (job.duration, job.periods) if length is not None]
    if len(given) != 1:
        sentence = "Give one of 'duration' (s) and 'periods'" + (", not both." if given else ".")
        raise InvalidInput.at("/duration", sentence)
    if job.settle >= given[0]:
        unit = "s" if job.periods is None else "periods"
        sentence = (
            f"Settling for {job.settle:g} {unit} leaves nothing of {given[0]:g} {unit} to look at;"
            " it must be shorter."
        )
        raise InvalidInput.at("/settle", sentence)
