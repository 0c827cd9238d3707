"""``jointplay run``: simulate here and now, without any service."""

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from jointplay.command_line.exits import Exit, Stopped
from jointplay.command_line.job_document import job_document
from jointplay.command_line.job_options import with_job_options
from jointplay.command_line.options import AS_JSON, JOB, SET
from jointplay.command_line.output import json_text, make_folder, tell

if TYPE_CHECKING:
    from jointplay.client import Job


@with_job_options()
def run(
    source: JOB,
    output: Annotated[
        Path, typer.Option("-o", "--output", metavar="OUT", help="Folder to make; must not exist.")
    ],
    settings: SET = None,
    processes: Annotated[
        int | None, typer.Option(min=1, max=1024, help="Of a study; default one for each core.")
    ] = None,
    figures: Annotated[
        bool, typer.Option(help="Draw all figures, too, as `jointplay plot OUT` does later.")
    ] = False,
    as_json: AS_JSON = False,
    **options: Any,
) -> None:
    """Simulate here and now, without any service; a study on all cores.

    OUT gets job.json (every default filled in: running it repeats the result), results.zarr.zip
    (a Zarr store in one file), outcome.json, peaks.csv, of a study points.csv or accuracy.json.
    Figures are drawn when they are asked for: `jointplay plot OUT`.  Ctrl-C ends the run and keeps
    what was computed.

    Examples: `jointplay run seven-bar-press --set clearance=5e-4 --duration 2 -o OUT`,
    `jointplay run seven-bar-press --bifurcation clearance=1e-4:1e-3:200 --record 50 -o DIAGRAM`
    """
    from jointplay.command_line.plot import draw_all
    from jointplay.command_line.summary import document_of, results_of
    from jointplay.local import load
    from jointplay.progress import progress
    from jointplay.solver.kinds import Study, admit
    from jointplay.worker.local.computing import compute

    admission = admit(job_document(source, settings=settings, options=options))
    if processes is not None and not isinstance(admission, Study):
        raise Stopped("--processes is of studies; this is one simulation.")
    make_folder(output)
    with progress(output.name) as report:
        compute(admission, output, processes, report)
    job = load(output)
    found = results_of(job)
    table = _write(found, output)
    if figures:
        draw_all(job, output / "figures")
    document = document_of(job, found)
    del document["statistics"]
    tell(document, _lines(job, found, table), as_json=as_json)
    job.check()
    points = document["points"]
    if points is not None and len(points["failures"]) == points["number"]:
        raise Stopped("every point failed; the first one says why above", Exit.FAILED)


def _write(found: dict[str, Any], output: Path) -> Path:
    """Write the table of results into the folder, and return its path."""
    from jointplay.command_line.peaks import peak_lines
    from jointplay.command_line.summary import units
    from jointplay.exports.study import point_lines

    if found["accuracy"] is not None:
        table, text = output / "accuracy.json", json_text(found["accuracy"]) + "\n"
    elif (study := found["points"]) is not None:
        channels = [channel.name for channel in study.channels]
        lines = point_lines(study, channels, range(study.points), units(study))
        table, text = output / "points.csv", "".join(lines)
    else:
        table, text = output / "peaks.csv", "".join(peak_lines(found["peaks"]))
    table.write_text(text)
    return table


def _lines(job: "Job", found: dict[str, Any], table: Path) -> Iterator[str]:
    from jointplay.command_line.peaks import headline
    from jointplay.command_line.summary import result_lines

    peaks, points = found["peaks"], found["points"]
    first = () if peaks is None else headline(job.results.source(None, None, None))
    yield from result_lines(job, found, first)
    if peaks is not None:
        yield f"all {len(peaks)} channels are in {table}"
    if points is not None:
        yield f"all {points.points} points are in {table}"
