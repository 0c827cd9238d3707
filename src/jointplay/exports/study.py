"""Studies as CSV or JSON text, piece by piece: memory does not grow with points and sections."""

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from jointplay.records.attractors import attractors_of
from jointplay.records.channel import TIME, by_name
from jointplay.records.point import PointStatus
from jointplay.records.run import Floats
from jointplay.records.study import StudySource, directions_of
from jointplay.records.text_tables import csv_lines, json_list, json_numbers, json_object

_BLOCK = 200_000  # values that are held at a time


def section_lines(
    source: StudySource,
    observables: Sequence[str],
    points: range,
    comments: Sequence[str] = (),
) -> Iterator[str]:
    """Write the sections of points as comma-separated values.

    Yields
    ------
    str
        Whole lines: the comments, one header row `point,clearance [m],section,time [s],A.x [m]`,
        then one row a section with 17 significant digits. Points of a continuation that goes both
        ways have a `direction` after `point`.
    """
    described = by_name(source.observables)
    directions = directions_of(source)
    titles = ["point", *([] if directions is None else ["direction"])]
    titles += [*(one.title for one in source.parameters), "section", TIME.title]
    titles += [described[name].title for name in observables]
    yield from csv_lines(titles, _section_blocks(source, observables, points, directions), comments)


def _section_blocks(
    source: StudySource,
    observables: Sequence[str],
    points: range,
    directions: NDArray[np.str_] | None,
) -> Iterator[list[NDArray[Any]]]:
    """Give the columns of `section_lines` for a few points at a time."""
    width = len(source.parameters) + len(observables) + 1
    for first, last in _blocks(points, width * source.record):
        inside = np.arange(source.record) < source.counts[first:last, None]
        row, section = np.nonzero(inside)
        yield [
            first + row,
            *([] if directions is None else [directions[first + row]]),
            *source.values[first + row].T,
            section,
            source.section_times(first, last)[inside],
            *(source.sections(name, first, last)[inside] for name in observables),
        ]


def point_lines(
    source: StudySource,
    channels: Sequence[str],
    points: range,
    units: Mapping[str, str],
    comments: Sequence[str] = (),
) -> Iterator[str]:
    """Write one row a point: its values, what became of it, extremes, indicators and statistics.

    Whole lines; numbers have 17 significant digits, what is not known is `nan`.  `units` are those
    of indicators and statistics, by name.
    """
    columns: dict[str, Any] = dict(words_of_points(source))
    columns |= {one.title: source.values[:, at] for at, one in enumerate(source.parameters)}
    columns |= columns_of_points(source, channels, units)
    yield from csv_lines(["point", *columns], _point_blocks(points, columns), comments)


def _point_blocks(points: range, columns: Mapping[str, Any]) -> Iterator[list[Any]]:
    """Give the columns of `point_lines` for a few points at a time."""
    for first, last in _blocks(points, 8 * len(columns)):
        yield [range(first, last), *(column[first:last] for column in columns.values())]


def section_json(source: StudySource, observables: Sequence[str], points: range) -> Iterator[str]:
    """Write the sections of points as one JSON document, in pieces.

    Yields
    ------
    str
        Pieces of `{"complete", "values": {parameter: [...]}, "status": [...], "direction": [...],
        "time": [[...]], "sections": {observable: [[...]]}}`: one inner list a point.
    """
    document = _head(source, points)
    directions = directions_of(source)
    if directions is not None:
        document["direction"] = [json.dumps(directions[points.start : points.stop].tolist())]
    document["time"] = _rows(source, points, "")
    sections = {name: _rows(source, points, name) for name in observables}
    yield from json_object({**document, "sections": json_object(sections)})
    yield "\n"


def point_json(
    source: StudySource, channels: Sequence[str], points: range, units: Mapping[str, str]
) -> Iterator[str]:
    """Write what has one number a point as one JSON document.

    Yields
    ------
    str
        Pieces of `{"complete", "values", "status", "direction", "verdict", "reason", "attractor",
        "columns"}`, the last by title.
    """
    part = slice(points.start, points.stop)
    document = _head(source, points)
    words = words_of_points(source)
    for name in ("direction", "verdict", "reason", "attractor"):
        if name in words:
            document[name] = [json.dumps(words[name][part])]
    found = columns_of_points(source, channels, units)
    columns = {title: json_list([json_numbers(one[part])]) for title, one in found.items()}
    yield from json_object({**document, "columns": json_object(columns)})
    yield "\n"


def _head(source: StudySource, points: range) -> dict[str, Iterable[str]]:
    part = slice(points.start, points.stop)
    columns = source.values[part].T.tolist()
    document = {
        "complete": source.complete,
        "first_point": points.start,
        "values": {one.name: columns[at] for at, one in enumerate(source.parameters)},
        "status": [PointStatus(code).name for code in source.status[part]],
    }
    return {name: [json.dumps(value)] for name, value in document.items()}


def _rows(source: StudySource, points: range, name: str) -> Iterator[str]:
    """Write the sections of each point as a list of its own; of no name their times."""
    counts = source.counts

    def lists() -> Iterator[str]:
        for first, last in _blocks(points, source.record):
            window = (first, last)
            table = source.sections(name, *window) if name else source.section_times(*window)
            for point, row in enumerate(table, first):
                yield f"[{json_numbers(row[: int(counts[point])])}]"

    return json_list(lists())


def columns_of_points(
    source: StudySource, channels: Sequence[str], units: Mapping[str, str]
) -> dict[str, Floats]:
    """Return counts of sections, extremes, indicators and statistics of all points, by title."""
    columns: dict[str, Floats] = {}
    if source.observables:
        columns["sections [1]"] = source.counts.astype(np.float64)
    described = {one.name: one.unit for one in source.channels}
    for name in channels:
        peaks, unit = source.peaks(name), described[name]
        columns[f"{name} minimum [{unit}]"] = peaks.minimum
        columns[f"{name} minimum at [s]"] = peaks.minimum_time
        columns[f"{name} maximum [{unit}]"] = peaks.maximum
        columns[f"{name} maximum at [s]"] = peaks.maximum_time
        columns[f"{name} range [{unit}]"] = peaks.maximum - peaks.minimum
    left_out = described.keys() - set(channels)
    for name, one in {**source.indicators, **source.statistics}.items():
        # a verdict is there as a word
        if name != "verdict" and name.rpartition(".")[0] not in left_out:
            columns[f"{name} [{units.get(name, '1')}]"] = one
    return columns


def words_of_points(source: StudySource) -> dict[str, list[str]]:
    """Return status, verdict with its reason, attractor, and code of a failure of all points.

    Where a continuation goes both ways, the direction is the first of them.
    """
    directions = directions_of(source)
    words = {} if directions is None else {"direction": directions.tolist()}
    words["status"] = [PointStatus(code).name for code in source.status]
    if source.verdicts is not None:
        names: NDArray[np.str_] = np.array([*source.verdict_names, ""])
        words["verdict"] = names[source.verdicts].tolist()
        reasons = source.reasons
        words["reason"] = [reasons.get(point, "") for point in range(source.points)]
    if "states" in source.attributes:
        found = attractors_of(source)
        named = {code: found.name_of(code) for code in np.unique(found.labels).tolist()}
        words["attractor"] = [named[code] for code in found.labels.tolist()]
    failures = source.failures
    words["failure"] = [
        failures[point].code if point in failures else "" for point in range(source.points)
    ]
    return words


def _blocks(points: range, width: int) -> Iterator[tuple[int, int]]:
    rows = max(_BLOCK // max(width, 1), 1)
    for first in range(points.start, points.stop, rows):
        yield first, min(first + rows, points.stop)
