"""The columns of a job's table: what goes into a file that is not written piece by piece."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from jointplay.exports.table_query import Table, check, point_range
from jointplay.records.channel_choice import choose
from jointplay.records.impact import IMPACT_UNITS
from jointplay.records.peak import PEAK
from jointplay.records.run import inside
from jointplay.records.study import directions_of
from jointplay.records.study_columns import channel_names, parameters, point_columns
from jointplay.records.table_files import Column
from jointplay.records.window_query import WindowQuery

if TYPE_CHECKING:
    from jointplay.client.readable_job import ReadableJob
    from jointplay.client.window import Window
    from jointplay.records.study import StudySource

Names = Sequence[str] | None


def columns_of(job: "ReadableJob", table: Table | None, query: WindowQuery) -> list[Column]:
    """Return the columns of a table of a job.

    Parameters
    ----------
    table
        By default the history of a simulation, of a study the sections or, without any, points.
    query
        Of a study `start` is the first point, and `stop` the one before which to end.

    Raises
    ------
    NoSuchTable
        A job of this kind has no such table.
    NoSuchPart
        The table has no such points, or what is asked would have no effect on it.
    """
    check(table, query, of_study=job.is_study)
    channels, start, stop = query.channels, query.start, query.stop
    if job.is_study:
        return list(_of_study(job, table, channels, start, stop))
    if table == "peaks":
        return list(_of_peaks(job, channels, start, stop))
    if table == "impacts":
        return list(_of_impacts(job, start, stop))
    if table == "poincare":
        return list(_of_window(job.results.sections(channels), start, stop))
    return list(_of_window(job.results.window(query), None, None))


def _of_window(window: "Window", start: float | None, stop: float | None) -> Iterator[Column]:
    shown = inside(window.time, start, stop)
    yield Column("time", "s", window.time[shown])
    for name, one in window.channels.items():
        yield Column(name, one.unit, one.values[shown])


def _of_peaks(
    job: "ReadableJob", channels: Names, start: float | None, stop: float | None
) -> Iterator[Column]:
    found = job.results.peaks(start, stop)
    names = choose(None if channels is None else ",".join(channels), list(found))
    yield Column("channel", "", np.array(names))
    yield Column("unit", "", np.array([found[name].unit for name in names]))
    for part, described in PEAK.items():
        values = np.array([getattr(found[name], part) for name in names], np.float64)
        yield Column(part, str(described.get("units", "")), values)


def _of_impacts(job: "ReadableJob", start: float | None, stop: float | None) -> Iterator[Column]:
    found = job.results.impacts()
    shown = inside(found.onset, start, stop)
    yield Column("joint", "", np.array(found.joint)[shown])
    for name, unit in IMPACT_UNITS.items():
        yield Column(name, unit, getattr(found, name)[shown])


def _of_study(
    job: "ReadableJob",
    table: Table | None,
    channels: Names,
    start: float | None,
    stop: float | None,
) -> Iterator[Column]:
    source = job.study(channels, channels)
    chosen = point_range(source.points, start, stop)
    first, last = chosen.start, chosen.stop
    if table == "points" or not source.observables:
        yield from _of_points(source, channels, slice(first, last))
        return
    counted = np.arange(source.record) < source.counts[first:last, None]
    row, section = np.nonzero(counted)
    yield Column("point", "", first + row)
    directions = directions_of(source)
    if directions is not None:
        yield Column("direction", "", directions[first + row])
    for one in parameters(source):
        yield replace(one, values=one.values[first + row])
    yield Column("section", "", section)
    yield Column("time", "s", source.section_times(first, last)[counted])
    wanted = choose(None if channels is None else ",".join(channels), _names(source.observables))
    units, called = {one.name: one.unit for one in source.observables}, channel_names(source)
    for name in wanted:
        yield Column(called[name], units[name], source.sections(name, first, last)[counted])


def _of_points(source: "StudySource", channels: Names, part: slice) -> Iterator[Column]:
    yield Column("point", "", np.arange(part.start, part.stop))
    wanted = choose(None if channels is None else ",".join(channels), _names(source.channels))
    for one in point_columns(source, wanted):
        yield replace(one, values=one.values[part])


def _names(described: Sequence[Any]) -> list[str]:
    return [one.name for one in described]
