"""The text of an export: which table, as CSV or JSON, in pieces."""

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Literal, NamedTuple

from jointplay.command_line.exits import Exit, Stopped
from jointplay.command_line.job_options import listed

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

    def check(self) -> None:
        """Refuse windows that are none, with `Stopped`."""
        for option, time in (("--start", self.start), ("--stop", self.stop)):
            if time is not None and not math.isfinite(time):
                raise Stopped(Exit.BAD_INPUT, f"{option} {time}: give a time in seconds.")
        if self.start is not None and self.stop is not None and self.start > self.stop:
            line = f"--stop {self.stop:g} is before --start {self.start:g}; swap them."
            raise Stopped(Exit.BAD_INPUT, line)
        if self.points is not None and self.table not in (None, "history"):
            line = f"--points is of a history; {self.table} is written as it is."
            raise Stopped(Exit.BAD_INPUT, line)


class Text(NamedTuple):
    """Text to write, and about how many values it has."""

    pieces: Iterator[str]
    values: int


def text_of(job: "Job", asked: Asked) -> Text:
    """Return the text of a job's table."""
    known = _OF_STUDIES if job.is_study else _OF_SIMULATIONS
    if asked.table is not None and asked.table not in known:
        what = "a study" if job.is_study else "a simulation"
        line = f"--table {asked.table}: {what} has {', '.join(known)}."
        raise Stopped(Exit.BAD_INPUT, line)
    if job.is_study:
        return _study(job, asked)
    if asked.table in ("peaks", "impacts"):
        return _rows(job, asked)
    if asked.table == "poincare":
        return _channels(job.results.sections(listed(asked.channels)).dataset(), asked)
    if asked.points is not None:
        window = job.window(listed(asked.channels), asked.start, asked.stop, points=asked.points)
        asked = asked._replace(channels=None, start=None, stop=None)
        return _channels(window.dataset(), asked)
    source = job.results.source(listed(asked.channels), asked.start, asked.stop)
    return _channels(source, asked)


def point_range(points: int, start: float | None, stop: float | None) -> range:
    """Return the points that --start and --stop mean for a study."""
    for option, value in (("--start", start), ("--stop", stop)):
        if value is not None and (value < 0 or value != int(value)):
            line = f"{option} {value:g}: points of a study are counted from 0."
            raise Stopped(Exit.BAD_INPUT, line)
    chosen = range(points)[
        None if start is None else int(start) : None if stop is None else int(stop)
    ]
    if not chosen:
        line = f"There is no such point; the study has points 0 to {points - 1}."
        raise Stopped(Exit.BAD_INPUT, line)
    return chosen


def _channels(source: "Source", asked: Asked) -> Text:
    from jointplay.exports import run as formats

    names = _chosen(asked.channels, [channel.name for channel in source.channels])
    window = asked.start, asked.stop
    first, last = source.between(*window)
    if first == last:
        raise Stopped(Exit.BAD_INPUT, "There are no samples in this window of time.")
    values = (last - first) * (len(names) + 1)
    if asked.form == "json":
        return Text(formats.json_pieces(source, names, *window), values)
    return Text(formats.csv_lines(source, names, *window, _comments(source)), values)


def _rows(job: "Job", asked: Asked) -> Text:
    """Return peaks or impacts: tables that are small."""
    from jointplay.command_line.impacts import impact_lines, impact_rows
    from jointplay.command_line.output import json_text
    from jointplay.command_line.peaks import peak_lines, rows_of

    if asked.table == "peaks":
        peaks = job.results.peaks()
        names = _chosen(asked.channels, list(peaks))
        rows = rows_of({name: peaks[name] for name in names})
        if asked.form == "json":
            document = {"peaks": rows}
            return Text(iter([json_text(document) + "\n"]), len(rows))
        return Text(peak_lines(rows), 5 * len(rows))
    impacts = impact_rows(job.results.impacts(), asked.start, asked.stop)
    if asked.form == "json":
        return Text(iter([json_text({"impacts": impacts}) + "\n"]), len(impacts))
    return Text(impact_lines(impacts), 6 * len(impacts))


def _study(job: "Job", asked: Asked) -> Text:
    from jointplay.command_line.study_summary import units
    from jointplay.exports import study as formats

    wanted = listed(asked.channels)
    source = job.study(wanted, wanted)
    chosen = point_range(source.points, asked.start, asked.stop)
    if asked.points is not None:
        raise Stopped(Exit.BAD_INPUT, "--points is of simulations; this is a study.")
    if asked.table == "points" or not source.observables:
        names = _chosen(asked.channels, [one.name for one in source.channels])
        values = len(chosen) * (4 * len(names) + len(source.parameters) + 3)
        if asked.form == "json":
            return Text(formats.point_json(source, names, chosen, units(source)), values)
        lines = formats.point_lines(source, names, chosen, units(source), _comments(source))
        return Text(lines, values)
    names = _chosen(asked.channels, [one.name for one in source.observables])
    values = int(source.counts[chosen.start : chosen.stop].sum()) * (len(names) + 3)
    if asked.form == "json":
        return Text(formats.section_json(source, names, chosen), values)
    return Text(formats.section_lines(source, names, chosen, _comments(source)), values)


def _comments(source: "Source | StudySource") -> list[str]:
    comments = [] if source.complete else ["incomplete: the job runs, or failed or was cancelled"]
    if not source.attributes.get("exact", True):
        comments.append("smallest and largest values of groups of samples, two rows a group")
    return comments


def _chosen(channels: str | None, names: list[str]) -> list[str]:
    from jointplay.records.channel_choice import NoSuchChannel, choose

    try:
        return choose(channels, names)
    except NoSuchChannel as error:
        raise Stopped(Exit.BAD_INPUT, f"--channels: {error}") from None
