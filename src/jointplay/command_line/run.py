"""``jointplay run``: simulate here and now, without any service."""

from pathlib import Path
from typing import Annotated, Any

import typer

from jointplay.command_line.exits import Stopped
from jointplay.command_line.job_document import job_document, replaced_numbers
from jointplay.command_line.job_options import with_job_options
from jointplay.command_line.local_run import compute_and_show
from jointplay.command_line.options import AS_JSON, JOB_ARGUMENT, SET
from jointplay.command_line.output import make_folder, remark


@with_job_options()
def run(
    source: Annotated[str | None, JOB_ARGUMENT] = None,
    output: Annotated[
        Path | None,
        typer.Option("-o", "--output", metavar="OUT", help="Folder to make; must not exist."),
    ] = None,
    settings: SET = None,
    resume: Annotated[
        Path | None,
        typer.Option(
            metavar="OUT", help="Go on with a run that was cut short, to the same bits; no more."
        ),
    ] = None,
    processes: Annotated[
        int | None, typer.Option(min=1, max=1024, help="Of a study; default one for each core.")
    ] = None,
    device: Annotated[
        str, typer.Option(metavar="cpu|auto|cuda:N", help="Of a study: a graphics processor.")
    ] = "cpu",
    figures: Annotated[
        bool, typer.Option(help="Draw all figures, too, as `jointplay plot OUT` does later.")
    ] = False,
    as_json: AS_JSON = False,
    **options: Any,
) -> None:
    """Simulate here and now, without any service; a study on all cores.

    OUT gets job.json (every default filled in: running it repeats the result), results.zarr.zip
    (a Zarr store in one file), outcome.json, peaks.csv, of a study points.csv or accuracy.json.
    Figures are drawn when they are asked for: `jointplay plot OUT`.  Ctrl-C, SIGTERM, SIGHUP and a
    full disk end the run and keep what was computed; --resume OUT goes on from there.  With
    --device a graphics processor computes the points of a study, to the same bits; `jointplay
    doctor --device` says whether it serves.

    Examples: `jointplay run seven-bar-press --set clearance=5e-4 --duration 2 -o OUT`,
    `jointplay run seven-bar-press --bifurcation clearance=1e-4:1e-3:200 --record 50 -o DIAGRAM`
    """
    from jointplay.local.running import unfinished
    from jointplay.solver.kinds import Study, admit
    from jointplay.worker.local.devices import lanes_of
    from jointplay.worker.local.folder import write_job

    if resume is not None:
        _insist_alone(source, output, settings, options)
        admission, output = unfinished(resume), resume
    else:
        source, output = _insist_on_both(source, output)
        job = job_document(source, settings=settings, options=options)
        admission = admit(job)
        remark(replaced_numbers(job, settings))
    if processes is not None and admission is not None and not isinstance(admission, Study):
        raise Stopped("--processes is of studies; this is one simulation.")
    lanes = None if admission is None else lanes_of(device, admission)
    if resume is None and admission is not None:
        make_folder(output)
        write_job(output, admission.job)  # first of all, whatever happens next
    compute_and_show(admission, output, processes, lanes, figures=figures, as_json=as_json)


def _insist_alone(source: object, output: object, settings: object, options: Any) -> None:
    # of numbers 0 is given, too
    given = [one for one in options.values() if not (one is None or one is False or one == [])]
    if source or output or settings or given:
        raise Stopped(
            "--resume OUT goes on with OUT/job.json as it is; beside it there can only be"
            " --processes, --device, --figures and --json."
        )


def _insist_on_both(source: str | None, output: Path | None) -> tuple[str, Path]:
    if source is None:
        raise Stopped(
            "Missing argument 'JOB.json|SCENE.json|PRESET': name what to simulate, such as"
            " slider-crank (jointplay scene list), or --resume a run."
        )
    if output is None:
        raise Stopped(
            "Missing option '--output' / '-o': name a folder for the results, such as -o OUT."
        )
    return source, output
