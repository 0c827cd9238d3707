"""The text of an export: which table, as CSV or JSON, in pieces."""

from collections.abc import Iterator
from typing import TYPE_CHECKING, Literal, NamedTuple

from jointplay.command_line.exits import Stopped
from jointplay.command_line.typed_window import check_ends
from jointplay.exports.table_query import Table, check, point_range
from jointplay.records.window_query import WindowQuery

if TYPE_CHECKING:
    from jointplay.client import Job
    from jointplay.records.run import Source
    from jointplay.records.study import StudySource

Form = Literal["csv", "json"]


class Asked(NamedTuple):
    """Part of the results to write, as it was typed."""

    table: Table | None
    query: WindowQuery
    form: Form

    def check(self) -> None:
        """Refuse windows that are none, with `Stopped`."""
        points, step = self.query.points, self.query.step
        check_ends(self.query.start, self.query.stop)
        if step is not None and (points is not None or not step > 0.0):
            raise Stopped("--step is a time in seconds between instants, without --points.")


class Text(NamedTuple):
    """Text to write, and about how many values it has."""

    pieces: Iterator[str]
    values: int


def text_of(job: "Job", asked: Asked) -> Text:
    """Return the text of a job's table; refuses what `check` and `point_range` refuse."""
    check(asked.table, asked.query, of_study=job.is_study)
    if job.is_study:
        return _study(job, asked)
    if asked.table in ("peaks", "impacts"):
        return _rows(job, asked)
    if asked.table == "poincare":
        return _channels(job.results.sections(asked.query.channels).dataset(), asked)
    if asked.query.of_samples:
        return _channels(job.results.source(asked.query), asked)
    window = job.results.window(asked.query).dataset()
    return _channels(window, asked._replace(query=WindowQuery()))


def _channels(source: "Source", asked: Asked) -> Text:
    from jointplay.exports.run import csv_lines, json_pieces

    names = _chosen(asked, [channel.name for channel in source.channels])
    window = asked.query.start, asked.query.stop
    first, last = source.between(*window)
    if first == last:
        raise Stopped("There are no samples in this window of time.")
    values = (last - first) * (len(names) + 1)
    if asked.form == "json":
        return Text(json_pieces(source, names, *window), values)
    return Text(csv_lines(source, names, *window, _comments(source)), values)


def _rows(job: "Job", asked: Asked) -> Text:
    """Return peaks or impacts: tables that are small."""
    from jointplay.command_line.output import json_text
    from jointplay.command_line.peaks import impact_lines, impact_rows, peak_lines, peak_rows

    start, stop = asked.query.start, asked.query.stop
    if asked.table == "peaks":
        peaks = job.results.peaks(start, stop)
        names = _chosen(asked, list(peaks))
        rows, lines = peak_rows({name: peaks[name] for name in names}), peak_lines
    else:
        rows, lines = impact_rows(job.results.impacts(), start, stop), impact_lines
    if asked.form == "json":
        return Text(iter([json_text({asked.table: rows}) + "\n"]), len(rows))
    return Text(lines(rows), 6 * len(rows))


def _study(job: "Job", asked: Asked) -> Text:
    from jointplay.exports.study import point_json, point_lines, section_json, section_lines

    query = asked.query
    source = job.study(query.channels, query.channels)
    chosen = point_range(source.points, query.start, query.stop)
    of_points = asked.table == "points" or not source.observables
    offered = source.channels if of_points else source.observables
    names = _chosen(asked, [one.name for one in offered])
    comments = _comments(source)
    if of_points:
        values = len(chosen) * (4 * len(names) + len(source.parameters) + 3)
        if asked.form == "json":
            return Text(point_json(source, names, chosen), values)
        return Text(point_lines(source, names, chosen, comments), values)
    values = int(source.counts[chosen.start : chosen.stop].sum()) * (len(names) + 3)
    if asked.form == "json":
        return Text(section_json(source, names, chosen), values)
    return Text(section_lines(source, names, chosen, comments), values)


def _comments(source: "Source | StudySource") -> list[str]:
    comments = [] if source.complete else ["incomplete: the job runs, or failed or was cancelled"]
    if not source.attributes.get("exact", True):
        comments.append("smallest and largest values of spans of time, two rows a span")
    return comments


def _chosen(asked: Asked, names: list[str]) -> list[str]:
    from jointplay.records.channel_choice import NoSuchChannel, choose

    channels = asked.query.channels
    try:
        return choose(None if channels is None else ",".join(channels), names)
    except NoSuchChannel as error:
        raise Stopped(f"--channels: {error}") from None
