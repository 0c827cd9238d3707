"""Studies as CSV or JSON text, piece by piece: memory does not grow with points and sections."""

import json
from collections.abc import Iterable, Iterator, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from jointplay.records.channel import TIME, by_name
from jointplay.records.point import PointStatus
from jointplay.records.study import StudySource, directions_of
from jointplay.records.study_columns import (
    channel_names,
    parameters,
    point_columns,
    results,
    words,
)
from jointplay.records.table_files import Column
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
    titles += [*(one.title for one in parameters(source)), "section", TIME.title]
    called = channel_names(source)
    titles += [described[name]._replace(name=called[name]).title for name in observables]
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
    comments: Sequence[str] = (),
) -> Iterator[str]:
    """Write one row a point: its values, what became of it, extremes, indicators and statistics.

    Whole lines; numbers have 17 significant digits, what is not known is `nan`.
    """
    columns = point_columns(source, channels)
    titles = ["point", *(one.title for one in columns)]
    yield from csv_lines(titles, _point_blocks(points, columns), comments)


def _point_blocks(points: range, columns: Sequence[Column]) -> Iterator[list[Any]]:
    """Give the columns of `point_lines` for a few points at a time."""
    for first, last in _blocks(points, 8 * len(columns)):
        yield [range(first, last), *(one.values[first:last] for one in columns)]


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


def point_json(source: StudySource, channels: Sequence[str], points: range) -> Iterator[str]:
    """Write what has one number a point as one JSON document.

    Yields
    ------
    str
        Pieces of `{"complete", "values", "status", "direction", "verdict", "reason", "attractor",
        "columns"}`, the last by title.
    """
    part = slice(points.start, points.stop)
    document = _head(source, points)
    for one in words(source):
        if one.name in ("direction", "verdict", "reason", "attractor"):
            document[one.name] = [json.dumps(one.values[part].tolist())]
    found = results(source, channels)
    columns = {one.title: json_list([json_numbers(one.values[part])]) for one in found}
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


def _blocks(points: range, width: int) -> Iterator[tuple[int, int]]:
    rows = max(_BLOCK // max(width, 1), 1)
    for first in range(points.start, points.stop, rows):
        yield first, min(first + rows, points.stop)
