"""The text of an export: which table, as CSV or JSON, in pieces."""

from collections.abc import Iterator
from typing import TYPE_CHECKING, Literal, NamedTuple

from jointplay.command_line.exits import Stopped
from jointplay.command_line.options import listed
from jointplay.command_line.typed_window import check_ends
from jointplay.records.window_query import WindowQuery

if TYPE_CHECKING:
    from jointplay.client import Job
    from jointplay.records.run import Source
    from jointplay.records.study import StudySource

Form = Literal["csv", "json"]
Table = Literal["history", "poincare", "peaks", "impacts", "points"]
_OF_SIMULATIONS = ("history", "poincare", "peaks", "impacts")
_OF_STUDIES = ("poincare", "points")


class Asked(NamedTuple):
    """Part of the results to write, as it was typed."""

    table: Table | None
    channels: str | None
    start: float | None
    stop: float | None
    points: int | None
    form: Form
    step: float | None = None

    def check(self) -> None:
        """Refuse windows that are none, with `Stopped`."""
        check_ends(self.start, self.stop)
        for option, asked in (("--points", self.points), ("--step", self.step)):
            if asked is not None and self.table not in (None, "history"):
                raise Stopped(f"{option} is of a history; {self.table} is written as it is.")
        if self.step is not None and (self.points is not None or not self.step > 0.0):
            raise Stopped("--step is a time in seconds between instants, without --points.")


class Text(NamedTuple):
    """Text to write, and about how many values it has."""

    pieces: Iterator[str]
    values: int


def text_of(job: "Job", asked: Asked) -> Text:
    """Return the text of a job's table."""
    known = _OF_STUDIES if job.is_study else _OF_SIMULATIONS
    if asked.table is not None and asked.table not in known:
        what = "a study" if job.is_study else "a simulation"
        raise Stopped(f"--table {asked.table}: {what} has {', '.join(known)}.")
    if job.is_study:
        return _study(job, asked)
    channels = listed(asked.channels)
    if asked.table in ("peaks", "impacts"):
        return _rows(job, asked)
    if asked.table == "poincare":
        return _channels(job.results.sections(channels).dataset(), asked)
    if asked.points is not None or asked.step is not None:
        window = job.window(channels, asked.start, asked.stop, points=asked.points, step=asked.step)
        asked = asked._replace(channels=None, start=None, stop=None)
        return _channels(window.dataset(), asked)
    return _channels(job.results.source(WindowQuery(channels, asked.start, asked.stop)), asked)


def _channels(source: "Source", asked: Asked) -> Text:
    from jointplay.exports.run import csv_lines, json_pieces

    names = _chosen(asked.channels, [channel.name for channel in source.channels])
    window = asked.start, asked.stop
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

    if asked.table == "peaks":
        peaks = job.results.peaks(asked.start, asked.stop)
        names = _chosen(asked.channels, list(peaks))
        rows, lines = peak_rows({name: peaks[name] for name in names}), peak_lines
    else:
        rows, lines = impact_rows(job.results.impacts(), asked.start, asked.stop), impact_lines
    if asked.form == "json":
        return Text(iter([json_text({asked.table: rows}) + "\n"]), len(rows))
    return Text(lines(rows), 6 * len(rows))


def _study(job: "Job", asked: Asked) -> Text:
    from jointplay.command_line.summary import units
    from jointplay.exports.study import point_json, point_lines, section_json, section_lines

    wanted = listed(asked.channels)
    source = job.study(wanted, wanted)
    chosen = _point_range(source.points, asked.start, asked.stop)
    if asked.points is not None or asked.step is not None:
        raise Stopped("--points and --step are of simulations; this is a study.")
    of_points = asked.table == "points" or not source.observables
    offered = source.channels if of_points else source.observables
    names = _chosen(asked.channels, [one.name for one in offered])
    comments = _comments(source)
    if of_points:
        values = len(chosen) * (4 * len(names) + len(source.parameters) + 3)
        if asked.form == "json":
            return Text(point_json(source, names, chosen, units(source)), values)
        return Text(point_lines(source, names, chosen, units(source), comments), values)
    values = int(source.counts[chosen.start : chosen.stop].sum()) * (len(names) + 3)
    if asked.form == "json":
        return Text(section_json(source, names, chosen), values)
    return Text(section_lines(source, names, chosen, comments), values)


def _point_range(points: int, start: float | None, stop: float | None) -> range:
    """Return the points that --start and --stop mean for a study."""
    for option, value in (("--start", start), ("--stop", stop)):
        if value is not None and (value < 0 or value != int(value)):
            raise Stopped(f"{option} {value:g}: points of a study are counted from 0.")
    last = points if stop is None else min(int(stop), points)
    chosen = range(int(start or 0), last)
    if not chosen:
        raise Stopped(f"There is no such point; the study has points 0 to {points - 1}.")
    return chosen


def _comments(source: "Source | StudySource") -> list[str]:
    comments = [] if source.complete else ["incomplete: the job runs, or failed or was cancelled"]
    if not source.attributes.get("exact", True):
        comments.append("smallest and largest values of spans of time, two rows a span")
    return comments


def _chosen(channels: str | None, names: list[str]) -> list[str]:
    from jointplay.records.channel_choice import NoSuchChannel, choose

    try:
        return choose(channels, names)
    except NoSuchChannel as error:
        raise Stopped(f"--channels: {error}") from None
