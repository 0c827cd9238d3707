"""``jointplay export``: channels, sections or points as CSV or JSON."""

import math
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal, NamedTuple

import typer

from jointplay.command_line import connection, output_folder
from jointplay.command_line.exits import Exit, Stopped
from jointplay.command_line.study_options import listed

if TYPE_CHECKING:
    from jointplay.source import Source
    from jointplay.study_source import StudySource


Form = Literal["csv", "json"]


def export(
    results: Annotated[
        str, typer.Argument(metavar="OUT|ID", help="Folder of `jointplay run`, or id of a job.")
    ],
    channels: Annotated[
        str | None,
        typer.Option(metavar="A,B", help="Names or globs such as 'slider7.*'; default all."),
    ] = None,
    start: Annotated[
        float | None,
        typer.Option(metavar="SECONDS", help="From this time; first point of a study."),
    ] = None,
    stop: Annotated[
        float | None, typer.Option(metavar="SECONDS", help="To this time; before this point.")
    ] = None,
    points: Annotated[
        bool,
        typer.Option(
            "--points", help="Of a study: one row a point, with verdicts, not its sections."
        ),
    ] = False,
    form: Annotated[Form, typer.Option("--format", help="Text format.")] = "csv",
    output: Annotated[
        Path | None, typer.Option("-o", "--output", metavar="FILE", help="Default: stdout.")
    ] = None,
    url: connection.URL = connection.DEFAULT_URL,
) -> None:
    """Write channels on the output grid, or a study's sections, with 17 significant digits.

    Of a sweep, one row a point: its values and the extremes of the channels.

    Examples: `jointplay export OUT --channels slider7.x,A.normal_force --stop 0.1 -o press.csv`,
    `jointplay export OUT --points -o verdicts.csv`
    """
    _check_window(start, stop)
    if output_folder.is_of_service(results):
        text = _of_service(results, channels, start, stop, points, form, url)
    else:
        text = _local(Path(results), channels, start, stop, points, form)
    if output is None:
        sys.stdout.writelines(text.pieces)
        return
    _write(text, output)


class _Text(NamedTuple):
    """What is written, and how many values that are."""

    pieces: Iterator[str]
    values: int


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


def _check_window(start: float | None, stop: float | None) -> None:
    for option, time in (("--start", start), ("--stop", stop)):
        if time is not None and not math.isfinite(time):
            raise Stopped(Exit.BAD_INPUT, f"{option} {time}: give a time in seconds.")
    if start is not None and stop is not None and start > stop:
        line = f"--stop {stop:g} is before --start {start:g}; swap them."
        raise Stopped(Exit.BAD_INPUT, line)


def _write(text: _Text, output: Path) -> None:
    """Write the text to a file; a comma a value tells how far it is."""
    from jointplay.command_line.progress import progress

    written = 0
    with output.open("w", encoding="utf-8") as file, progress(output.name) as report:
        for piece in text.pieces:
            file.write(piece)
            written += piece.count(",")
            report(min(written / max(text.values, 1), 0.99), "")
        report(1.0, "")


def _local(
    folder: Path,
    channels: str | None,
    start: float | None,
    stop: float | None,
    points: bool,
    form: Form,
) -> _Text:
    from jointplay.figures import is_study

    source = output_folder.results_in(folder)
    if is_study(source):
        return _study(source, channels, start, stop, points, form)
    _no_points(points)
    names = _chosen(channels, [channel.name for channel in source.channels])
    return _history(source, names, start, stop, form)


def _of_service(
    job_id: str,
    channels: str | None,
    start: float | None,
    stop: float | None,
    points: bool,
    form: Form,
    url: str,
) -> _Text:
    from jointplay.dataset import Channel, Dataset

    wanted = listed(channels)
    with connection.connect(url) as client:
        if client.get(job_id).kind != "simulate":
            study = client.study(job_id, observables=wanted, channels=wanted)
            return _study(study, None, start, stop, points, form)
        _no_points(points)
        history = client.history(job_id, wanted, start, stop)
    dataset = Dataset(
        attributes={},
        channels=[Channel(name, one.unit, one.long_name) for name, one in history.channels.items()],
        time=history.time,
        values={name: one.values for name, one in history.channels.items()},
        complete=history.complete,
    )
    return _history(dataset, list(history.channels), start, stop, form)


def _history(
    source: "Source", names: list[str], start: float | None, stop: float | None, form: Form
) -> _Text:
    from jointplay import export as formats

    first, last = source.between(start, stop)
    if first == last:
        raise Stopped(Exit.BAD_INPUT, "There are no samples in this window of time.")
    values = (last - first) * (len(names) + 1)
    if form == "json":
        return _Text(formats.json_pieces(source, names, start, stop), values)
    return _Text(formats.csv_lines(source, names, start, stop, _comments(source)), values)


def _study(
    source: "StudySource",
    channels: str | None,
    start: float | None,
    stop: float | None,
    points: bool,
    form: Form,
) -> _Text:
    from jointplay import study_export as formats
    from jointplay.command_line.study_summary import units

    chosen = point_range(source.points, start, stop)
    if points or not source.observables:
        names = _chosen(channels, [one.name for one in source.channels])
        values = len(chosen) * (4 * len(names) + len(source.parameters) + 3)
        if form == "json":
            return _Text(formats.point_json(source, names, chosen, units()), values)
        lines = formats.point_lines(source, names, chosen, units(), _comments(source))
        return _Text(lines, values)
    names = _chosen(channels, [one.name for one in source.observables])
    values = int(source.counts[chosen.start : chosen.stop].sum()) * (len(names) + 3)
    if form == "json":
        return _Text(formats.section_json(source, names, chosen), values)
    return _Text(formats.section_lines(source, names, chosen, _comments(source)), values)


def _comments(source: "Source | StudySource") -> list[str]:
    return [] if source.complete else ["incomplete: the job runs, or failed or was cancelled"]


def _chosen(channels: str | None, names: list[str]) -> list[str]:
    from jointplay.channel_choice import NoSuchChannel, choose

    try:
        return choose(channels, names)
    except NoSuchChannel as error:
        raise Stopped(Exit.BAD_INPUT, f"--channels: {error}") from None


def _no_points(points: bool) -> None:
    if points:
        raise Stopped(Exit.BAD_INPUT, "--points is of studies; this is a simulation.")
