"""Studies as CSV or JSON text, piece by piece: memory does not grow with points and sections."""

import json
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from jointplay.records.channel import TIME, by_name
from jointplay.records.point import PointStatus
from jointplay.records.run import Floats
from jointplay.records.study import StudySource
from jointplay.records.text_tables import csv_lines, json_numbers

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
        then one row a section with 17 significant digits.
    """
    described = by_name(source.observables)
    titles = ["point", *(one.title for one in source.parameters), "section", TIME.title]
    titles += [described[name].title for name in observables]
    yield from csv_lines(titles, _section_blocks(source, observables, points), comments)


def _section_blocks(
    source: StudySource, observables: Sequence[str], points: range
) -> Iterator[list[NDArray[Any]]]:
    """Give the columns of `section_lines` for a few points at a time."""
    width = len(source.parameters) + len(observables) + 1
    for first, last in _blocks(points, width * source.record):
        inside = np.arange(source.record) < source.counts[first:last, None]
        row, section = np.nonzero(inside)
        yield [
            first + row,
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

    Parameters
    ----------
    units
        Of indicators and statistics, by name.

    Yields
    ------
    str
        Whole lines; numbers have 17 significant digits, what is not known is `nan`.
    """
    part = slice(points.start, points.stop)
    values = {one.title: source.values[:, at] for at, one in enumerate(source.parameters)}
    columns: dict[str, Any] = {
        **_words_of_points(source),
        **values,
        **_columns_of_points(source, channels, units),
    }
    rows = [points, *(column[part] for column in columns.values())]
    yield from csv_lines(["point", *columns], [rows], comments)


def section_json(source: StudySource, observables: Sequence[str], points: range) -> Iterator[str]:
    """Write the sections of points as one JSON document, in pieces.

    Yields
    ------
    str
        Pieces of `{"complete", "values": {parameter: [...]}, "status": [...], "time": [[...]],
        "sections": {observable: [[...]]}}`: one inner list a point.
    """
    yield _head(source, points)
    yield ', "time": '
    yield from _rows(source, points, "")
    yield ', "sections": {'
    for position, name in enumerate(observables):
        yield f"{', ' if position else ''}{json.dumps(name)}: "
        yield from _rows(source, points, name)
    yield "}}\n"


def point_json(
    source: StudySource, channels: Sequence[str], points: range, units: Mapping[str, str]
) -> Iterator[str]:
    """Write what has one number a point as one JSON document.

    Yields
    ------
    str
        Pieces of `{"complete", "values", "status", "verdict", "columns": {title: [...]}}`.
    """
    part = slice(points.start, points.stop)
    yield _head(source, points)
    words = _words_of_points(source)
    if "verdict" in words:
        yield f', "verdict": {json.dumps(words["verdict"][part])}'
    yield ', "columns": {'
    columns = _columns_of_points(source, channels, units)
    for position, (title, column) in enumerate(columns.items()):
        yield f"{', ' if position else ''}{json.dumps(title)}: [{json_numbers(column[part])}]"
    yield "}}\n"


def _head(source: StudySource, points: range) -> str:
    part = slice(points.start, points.stop)
    values = {
        one.name: source.values[part, column].tolist()
        for column, one in enumerate(source.parameters)
    }
    status = [PointStatus(code).name for code in source.status[part]]
    return (
        f'{{"complete": {json.dumps(source.complete)}, "first_point": {points.start}, '
        f'"values": {json.dumps(values)}, "status": {json.dumps(status)}'
    )


def _rows(source: StudySource, points: range, name: str) -> Iterator[str]:
    counts = source.counts
    yield "["
    separator = ""
    for first, last in _blocks(points, source.record):
        table = source.sections(name, first, last) if name else source.section_times(first, last)
        for point, row in enumerate(table, first):
            yield f"{separator}[{json_numbers(row[: int(counts[point])])}]"
            separator = ", "
    yield "]"


def _columns_of_points(
    source: StudySource, channels: Sequence[str], units: Mapping[str, str]
) -> dict[str, Floats]:
    columns: dict[str, Floats] = {}
    described = {one.name: one.unit for one in source.channels}
    for name in channels:
        peaks = source.peaks(name)
        columns[f"{name} minimum [{described[name]}]"] = peaks.minimum
        columns[f"{name} minimum at [s]"] = peaks.minimum_time
        columns[f"{name} maximum [{described[name]}]"] = peaks.maximum
        columns[f"{name} maximum at [s]"] = peaks.maximum_time
        columns[f"{name} range [{described[name]}]"] = peaks.maximum - peaks.minimum
    left_out = described.keys() - set(channels)
    for name, one in {**source.indicators, **source.statistics}.items():
        # a verdict is there as a word
        if name != "verdict" and name.rpartition(".")[0] not in left_out:
            columns[f"{name} [{units.get(name, '1')}]"] = one
    return columns


def _words_of_points(source: StudySource) -> dict[str, list[str]]:
    words = {"status": [PointStatus(code).name for code in source.status]}
    if source.verdicts is not None:
        names: NDArray[np.str_] = np.array([*source.verdict_names, ""])
        words["verdict"] = names[source.verdicts].tolist()
    failures = source.failures
    words["failure"] = [
        failures[point].code if point in failures else "" for point in range(source.points)
    ]
    return words


def _blocks(points: range, width: int) -> Iterator[tuple[int, int]]:
    rows = max(_BLOCK // max(width, 1), 1)
    for first in range(points.start, points.stop, rows):
        yield first, min(first + rows, points.stop)
