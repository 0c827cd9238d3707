"""``jointplay run``: simulate here and now, without any service."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from jointplay.command_line import job_document
from jointplay.command_line.exits import Exit, Stopped
from jointplay.command_line.job_options import with_job_options
from jointplay.command_line.output import AS_JSON, json_text, print_json

if TYPE_CHECKING:
    from jointplay.client import Job
    from jointplay.local.drawing_process import DrawingProcess


@with_job_options()
def run(
    source: job_document.JOB,
    output: Annotated[
        Path, typer.Option("-o", "--output", metavar="OUT", help="Folder to make; must not exist.")
    ],
    settings: job_document.SET = None,
    processes: Annotated[
        int | None, typer.Option(min=1, max=1024, help="Of a study; default one for each core.")
    ] = None,
    as_json: AS_JSON = False,
    **options: Any,
) -> None:
    """Simulate here and now, without any service; a study on all cores.

    OUT gets job.json (every default filled in: running it repeats the result), results.zarr.zip
    (a Zarr store in one file), outcome.json, peaks.csv, of a study points.csv or accuracy.json,
    and figures.  Ctrl-C ends the run and keeps what was computed.

    Examples: `jointplay run seven-bar-press --set clearance=5e-4 --duration 2 -o OUT`,
    `jointplay run seven-bar-press --bifurcation clearance=1e-4:1e-3:200 --record 50 -o DIAGRAM`
    """
    from jointplay.local import load
    from jointplay.local.drawing_process import drawing_process
    from jointplay.progress import progress
    from jointplay.solver.kinds import Study, admit
    from jointplay.worker.local.computing import compute

    document = job_document.job_document(source, settings=settings, options=options)
    admission = admit(document)
    if processes is not None and not isinstance(admission, Study):
        raise Stopped(Exit.BAD_INPUT, "--processes is of studies; this is one simulation.")
    _make(output)
    with drawing_process(admission) as second:
        with progress(output.name) as report:
            compute(admission, output, processes, report)
        job = load(output)
        shown: dict[str, Any] = {"peaks": None, "points": None, "accuracy": None}
        if "accuracy" in job.links:
            shown |= _of_accuracy(job, output, as_json)
        elif isinstance(admission, Study):
            shown |= _of_study(job, output, as_json)
        else:
            shown |= _of_simulation(job, output, second, as_json)
    if as_json:
        print_json({"job": job.to_document(), **shown})
    job.check()
    points = shown["points"]
    if points is not None and len(points["failures"]) == points["number"]:
        raise Stopped(Exit.FAILED, "every point failed; the first one says why above")


def _make(output: Path) -> None:
    try:
        output.mkdir(parents=True)
    except FileExistsError:
        line = f"{output} exists already; results are never overwritten, name another folder."
        raise Stopped(Exit.BAD_INPUT, line) from None


def _of_simulation(
    job: "Job", output: Path, second: "DrawingProcess | None", as_json: bool
) -> dict[str, Any]:
    """Write figures and peaks, and tell the peaks."""
    from jointplay.command_line.certificate import print_headline
    from jointplay.command_line.drawing import draw_all
    from jointplay.command_line.peaks import headline, peak_lines, print_peaks, rows_of

    rows = rows_of(job.results.peaks())
    table = output / "peaks.csv"
    table.write_text("".join(peak_lines(rows)))
    draw_all(job, output / "figures", second)
    if not as_json:
        first = headline(job.results.source(None, None, None))
        print_peaks([row for row in rows if row["channel"] in first])
        print_headline(job)
        typer.echo(f"all {len(rows)} channels are in {table}")
    return {"peaks": rows}


def _of_study(job: "Job", output: Path, as_json: bool) -> dict[str, Any]:
    """Write points and figures, and tell what became of the points."""
    from jointplay.command_line.drawing import draw_all
    from jointplay.command_line.study_summary import print_points, summary_of, write_points

    study = job.study()
    table = output / "points.csv"
    write_points(study, table)
    draw_all(job, output / "figures")
    if not as_json:
        print_points(study)
        typer.echo(f"all {study.points} points are in {table}")
    return {"points": summary_of(study)}


def _of_accuracy(job: "Job", output: Path, as_json: bool) -> dict[str, Any]:
    """Write what every method costs and buys, with the figure, and tell it."""
    from jointplay.command_line.accuracy import print_accuracy
    from jointplay.command_line.drawing import draw_all

    found = job.accuracy
    (output / "accuracy.json").write_text(json_text(found) + "\n")
    draw_all(job, output / "figures")
    if not as_json:
        print_accuracy(found)
    return {"accuracy": found}
