"""The kind ``sweep``: peaks and statistics over any number of parameters."""

import math
from typing import Annotated, Any, ClassVar, Literal

import numpy as np
from pydantic import Field

from jointplay.records.failure import InvalidInput, Problem
from jointplay.solver.kinds import documents
from jointplay.solver.kinds.checked_points import check_points
from jointplay.solver.kinds.job import ChannelChoice, Job
from jointplay.solver.kinds.kind import Kind
from jointplay.solver.kinds.limits import check_count, check_size
from jointplay.solver.kinds.methods import check_study
from jointplay.solver.kinds.observables import chosen, coordinate_channels, peak_channels
from jointplay.solver.kinds.periods import Periods, periods
from jointplay.solver.kinds.points import Axis, Points, product
from jointplay.solver.kinds.statistics import (
    StatisticName,
    check_samples,
    check_statistics,
    statistic_count,
)
from jointplay.solver.kinds.studies import PlacedPoints, make_study, place_points
from jointplay.solver.kinds.values import UNIT, Values, axis, count
from jointplay.solver.quantities.units import Name, quantity
from jointplay.solver.runs.study.plan import Study

PointValues = Annotated[
    dict[Name, Annotated[float, quantity(UNIT)]], Field(min_length=1, max_length=64)
]


class SweepJob(Job):
    """Peaks and statistics at each point of a grid or list; one of `duration` and `periods`."""

    kind: Literal["sweep"]
    grid: Annotated[
        dict[Name, Values] | None,
        Field(
            min_length=1,
            max_length=64,
            description="values by parameter: their Cartesian product, the first varies slowest",
        ),
    ] = None
    points: Annotated[
        list[PointValues] | None,
        Field(min_length=1, description="or one value of each parameter for every point"),
    ] = None
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
    statistics: Annotated[
        list[StatisticName],
        Field(
            max_length=16,
            description=(
                "kept beside the peaks, over the time after settling; impacts (beginnings of"
                " contact), largest_impact_force (N) and contact_share (0 to 1) are of each joint"
                " with clearance, the others of each channel, in its unit"
            ),
            examples=[["mean", "root_mean_square"]],
        ),
    ] = []
    samples_per_period: Annotated[
        int,
        quantity(
            "1",
            ge=16,
            le=4096,
            description=(
                "samples in a period that statistics of channels are made of; they are equally"
                " spaced, of the dense output, in the scene's own time scale if the drivers have"
                " no period"
            ),
        ),
    ] = 256

    @property
    def named_channels(self) -> list[str]:
        """See `MechanismJob.named_channels`."""
        return self.channels or []


class Sweep(Kind[SweepJob]):
    """A point for each combination of values, or for each one that is listed."""

    document = SweepJob
    results: ClassVar = ("sweep", "figures", "zarr")

    def admit(self, job: SweepJob) -> Study:
        """Check and fill in; see `Kind.admit`."""
        check_study(job, tangents=False)
        _check_length(job)
        points = _points(job)
        checked = check_points(job, points)
        default = peak_channels(checked) or coordinate_channels(checked)
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
        study = _study(job, filled, checked, units)
        if job.statistics:
            check_samples(study, job.samples_per_period)
        longest = float((study.duration / study.period).max())
        check_size(study, longest, "/periods" if job.periods is not None else "/duration")
        return study

    def plan(self, job: SweepJob, filled: dict[str, Any]) -> Study:
        """Return what `admit` returned; see `Kind.plan`."""
        placed = place_points(job, _points(job))
        return _study(job, filled, placed, periods(placed.scenes))


def _study(job: SweepJob, filled: dict[str, Any], placed: PlacedPoints, units: Periods) -> Study:
    unit = units.seconds if job.periods is not None else np.ones(placed.points.count)
    length = job.duration if job.periods is None else job.periods
    channels = placed.channels(filled["channels"])
    pairs = placed.pairs()
    return make_study(
        filled,
        placed,
        channels=channels,
        statistics=statistic_count(job.statistics, len(channels), len(pairs)),
        period=units.seconds,
        offset=np.zeros(placed.points.count),
        settle=job.settle * unit,
        duration=(length or 0.0) * unit,
    )


def _check_length(job: SweepJob) -> None:
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


def _points(job: SweepJob) -> Points:
    if job.grid is not None and job.points is None:
        check_count(math.prod(count(values) for values in job.grid.values()), "/grid")
        axes = [
            axis(name, values, f"/grid/{name}", f"/grid/{name}")
            for name, values in job.grid.items()
        ]
        return product(axes, "/grid")
    if job.points is None or job.grid is not None:
        both = ", not both." if job.grid is not None else "."
        raise InvalidInput.at("/grid", f"Give one of 'grid' and 'points'{both}")
    check_count(len(job.points), "/points")
    return _listed(job.points)


def _listed(points: list[dict[str, float]]) -> Points:
    """Return points that are written one by one; each must name the same parameters."""
    names = list(points[0])
    for index, point in enumerate(points):
        if point.keys() != points[0].keys():
            lacking = [f"'{name}'" for name in names if name not in point]
            extra = [f"'{name}'" for name in point if name not in names]
            difference = " and ".join(
                text
                for text, found in (
                    (f"lacks {', '.join(lacking)}", lacking),
                    (f"has {', '.join(extra)} besides", extra),
                )
                if found
            )
            sentence = f"Point {index} {difference}; give every point the parameters of the first."
            raise InvalidInput.at(f"/points/{index}", sentence)
    written = np.arange(len(points), dtype=np.int64)
    return Points(
        tuple(
            Axis(
                name,
                f"/points/0/{name}",
                np.array([point[name] for point in points]),
                lambda at, name=name: f"/points/{at}/{name}",  # type: ignore[misc]
            )
            for name in names
        ),
        np.tile(written[:, None], (1, len(names))),
        lambda point: f"/points/{point}",
    )
