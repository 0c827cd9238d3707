"""``jointplay export``: channels, sections, impacts, peaks or points as CSV or JSON."""

import sys
from pathlib import Path
from typing import Annotated

import typer

from jointplay.command_line.exits import Stopped
from jointplay.command_line.exporting import Asked, Form, Text, text_of
from jointplay.command_line.options import DEFAULT_URL, RESULTS, START, STOP, URL, job_of, listed
from jointplay.command_line.typed_window import check_start
from jointplay.exports.table_query import NoSuchPart, NoSuchTable, Table
from jointplay.records.window_query import WindowQuery

TABLE = Annotated[
    Table | None,
    typer.Option(
        help="Of a simulation history (default), poincare, peaks or impacts; of a study its "
        "poincare sections, or one row for each of its points."
    ),
]
CHANNELS = Annotated[
    str | None,
    typer.Option(metavar="A,B", help="Names or globs such as 'slider7.*'; default all."),
]
POINTS = Annotated[
    int | None,
    typer.Option(
        min=1,
        metavar="N",
        help="Most pairs of smallest and largest values, as a screen shows them.",
    ),
]
STEP = Annotated[
    float | None,
    typer.Option(metavar="SECONDS", help="Values so far apart, between samples, too."),
]
FORM = Annotated[
    Form | None,
    typer.Option("--format", help="Text format; default what FILE ends in, or csv."),
]
AS_JSON = Annotated[bool, typer.Option("--json", help="The same as --format json.")]
OUTPUT = Annotated[
    Path | None,
    typer.Option(
        "-o",
        "--output",
        metavar="FILE",
        help="A .csv, .json, .npz, .mat, .arrow or .parquet; default CSV to stdout.",
    ),
]


def export(
    results: RESULTS,
    table: TABLE = None,
    channels: CHANNELS = None,
    start: START = None,
    stop: STOP = None,
    points: POINTS = None,
    step: STEP = None,
    form: FORM = None,
    as_json: AS_JSON = False,
    output: OUTPUT = None,
    url: URL = DEFAULT_URL,
) -> None:
    """Write a table of a job, every bit of it: by default channels, or sections.

    What FILE ends in says how.  Of a sweep, one row a point: its values and the extremes of the
    channels.

    Examples: `jointplay export OUT --channels slider7.x,A.normal_force --stop 0.1 -o press.csv`,
    `jointplay export OUT --start 0.02 --stop 0.03 --step 1e-6 -o impact.csv`,
    `jointplay export OUT --table points -o verdicts.csv`
    """
    text_form = "json" if as_json else form
    binary = output is not None and text_form is None and _is_binary(output)
    if text_form is None and output is not None and output.suffix == ".json":
        text_form = "json"
    query = WindowQuery(listed(channels), start, stop, points, step)
    asked = Asked(table, query, text_form or "csv")
    asked.check()
    with job_of(results, url) as job:
        check_start(job, start)
        try:
            if binary and output is not None:
                job.export(output, table, listed(channels), start, stop, points=points, step=step)
                return
            text = text_of(job, asked)
        except (NoSuchTable, NoSuchPart) as error:
            option = "--table: " if isinstance(error, NoSuchTable) else "--"
            raise Stopped(f"{option}{error}") from None
        if output is None:
            sys.stdout.writelines(text.pieces)
        else:
            _write(text, output)


def _is_binary(output: Path) -> bool:
    """Tell whether a file is no text, by its name; UnknownForm if it ends in anything else."""
    from jointplay.records.table_files import form_of

    return bool(form_of(output).SUFFIXES[0] not in (".csv", ".json"))


def _write(text: Text, output: Path) -> None:
    """Write the text to a file, whole or not at all; a comma a value tells how far it is."""
    from jointplay.progress import progress
    from jointplay.records.whole_file import whole

    written = 0
    with whole(output) as partial, progress(output.name) as report:
        with partial.open("w", encoding="utf-8") as file:
            for piece in text.pieces:
                file.write(piece)
                written += piece.count(",")
                report(min(written / max(text.values, 1), 0.99), "")
        report(1.0, "")
