"""``jointplay export``: channels as CSV or JSON."""

import math
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from jointplay.command_line import connection, output_folder
from jointplay.command_line.exits import Exit, Stopped

if TYPE_CHECKING:
    from jointplay.source import Source


Form = Literal["csv", "json"]


def export(
    results: Annotated[
        str, typer.Argument(metavar="OUT|ID", help="Folder of `jointplay run`, or id of a job.")
    ],
    channels: Annotated[
        str | None,
        typer.Option(metavar="A,B", help="Names or globs such as 'slider7.*'; default all."),
    ] = None,
    start: Annotated[float | None, typer.Option(metavar="SECONDS", help="From this time.")] = None,
    stop: Annotated[float | None, typer.Option(metavar="SECONDS", help="To this time.")] = None,
    form: Annotated[Form, typer.Option("--format", help="Text format.")] = "csv",
    output: Annotated[
        Path | None, typer.Option("-o", "--output", metavar="FILE", help="Default: stdout.")
    ] = None,
    url: connection.URL = connection.DEFAULT_URL,
) -> None:
    """Write channels on the output grid, with 17 significant digits.

    Example: `jointplay export OUT --channels slider7.x,A.normal_force --stop 0.1 -o press.csv`
    """
    _check_window(start, stop)
    if not output_folder.is_job_id(results):
        source, names = _local(Path(results), channels)
    else:
        source, names = _fetched(results, channels, start, stop, url)
    pieces = _text(source, names, start, stop, form)
    if output is None:
        sys.stdout.writelines(pieces)
        return
    first, last = source.between(start, stop)
    _write(pieces, output, values=(last - first) * (len(names) + 1))


def _check_window(start: float | None, stop: float | None) -> None:
    for option, time in (("--start", start), ("--stop", stop)):
        if time is not None and not math.isfinite(time):
            raise Stopped(Exit.BAD_INPUT, f"{option} {time}: give a time in seconds.")
    if start is not None and stop is not None and start > stop:
        line = f"--stop {stop:g} is before --start {start:g}; swap them."
        raise Stopped(Exit.BAD_INPUT, line)


def _write(pieces: Iterator[str], output: Path, values: int) -> None:
    """Write the text to a file; a comma a value tells how far it is."""
    from jointplay.command_line.progress import progress

    written = 0
    with output.open("w", encoding="utf-8") as file, progress(output.name) as report:
        for piece in pieces:
            file.write(piece)
            written += piece.count(",")
            report(min(written / max(values, 1), 0.99), "")
        report(1.0, "")


def _local(folder: Path, channels: str | None) -> "tuple[Source, list[str]]":
    from jointplay.channel_choice import NoSuchChannel, choose
    from storage.results import ResultReader

    reader = ResultReader(output_folder.store_in(folder))
    try:
        names = choose(channels, [channel.name for channel in reader.channels])
    except NoSuchChannel as error:
        raise Stopped(Exit.BAD_INPUT, f"--channels: {error}") from None
    return reader, names


def _fetched(
    job_id: str, channels: str | None, start: float | None, stop: float | None, url: str
) -> "tuple[Source, list[str]]":
    from jointplay.dataset import Channel, Dataset

    with connection.connect(url) as client:
        wanted = None if channels is None else channels.split(",")
        history = client.history(job_id, wanted, start, stop)
    dataset = Dataset(
        attributes={},
        channels=[Channel(name, one.unit, one.long_name) for name, one in history.channels.items()],
        time=history.time,
        values={name: one.values for name, one in history.channels.items()},
        complete=history.complete,
    )
    return dataset, list(history.channels)


def _text(
    source: "Source", names: list[str], start: float | None, stop: float | None, form: Form
) -> Iterator[str]:
    from jointplay import export as formats

    if form == "json":
        return formats.json_pieces(source, names, start, stop)
    comments = [] if source.complete else ["incomplete: the run failed or was cancelled"]
    return formats.csv_lines(source, names, start, stop, comments)
