"""Admission of the kind ``sweep``: peaks and statistics over any number of parameters."""

from __future__ import annotations

import math

import numpy as np

from jointplay.records.failure import InvalidInput, Problem
from jointplay.solver.admission import documents
from jointplay.solver.admission.methods import check_study
from jointplay.solver.admission.observables import chosen, coordinate_channels, peak_channels
from jointplay.solver.admission.points import Axis, Points, product
from jointplay.solver.admission.spans import periods
from jointplay.solver.admission.statistics import check_samples, check_statistics
from jointplay.solver.admission.studies import check_count, check_limits, make_study
from jointplay.solver.admission.varied import check_points
from jointplay.solver.admission.written import axis
from jointplay.solver.jobs.sweep import SweepJob
from jointplay.solver.jobs.values import count
from jointplay.solver.runs.study.plan import Study


def admit_sweep(job: SweepJob, *, thorough: bool = True) -> Study:
    """Check a parsed job and fill in its defaults.

    Raises
    ------
    InvalidInput
        With what is wrong, at its field or value.
    LimitExceeded
        The study is sound but too large; the sentence gives the estimate.
    """
    check_study(job, tangents=False)
    length = _length(job)
    points = _points(job)
    checked = check_points(job, points, thorough=thorough)
    default = peak_channels(checked) or coordinate_channels(checked)
    channels = chosen(checked, job.channels, default, "/channels")
    units = periods(checked)
    if job.periods is not None and units.notes:
        raise InvalidInput(
            Problem("/periods", f"{points.name(point, checked.declared)}{note} Give a 'duration'.")
            for point, note in units.notes.items()
        )
    second = units.seconds if job.periods is not None else np.ones(points.count)
    settle, duration = job.settle * second, length * second
    longest = float((duration / units.seconds).max())
    place = "/periods" if job.periods is not None else "/duration"
    numbers = check_statistics(job, checked, channels)
    check_samples(job, units.seconds, settle, duration)
    stored = check_limits(points.count, longest, place, channels=len(channels), statistics=numbers)
    filled = documents.filled(
        job, checked.document, checked.echo, channels=[channel.name for channel in channels]
    )
    return make_study(
        job,
        points,
        checked,
        filled,
        channels=channels,
        period=units.seconds,
        offset=np.zeros(points.count),
        settle=settle,
        duration=duration,
        stored_bytes=stored,
    )


def _length(job: SweepJob) -> float:
    """Return how long each point runs, in s or periods."""
    given = [length for length in (job.duration, job.periods) if length is not None]
    if len(given) != 1:
        sentence = "Give one of 'duration' (s) and 'periods'" + (", not both." if given else ".")
        raise InvalidInput([Problem("/duration", sentence)])
    if job.settle >= given[0]:
        unit = "s" if job.periods is None else "periods"
        sentence = (
            f"Settling for {job.settle:g} {unit} leaves nothing of {given[0]:g} {unit} to look at;"
            " it must be shorter."
        )
        raise InvalidInput([Problem("/settle", sentence)])
    return given[0]


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
        raise InvalidInput([Problem("/grid", f"Give one of 'grid' and 'points'{both}")])
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
            raise InvalidInput([Problem(f"/points/{index}", sentence)])
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
