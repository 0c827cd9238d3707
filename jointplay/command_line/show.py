"""``jointplay show``: one job, and what became of it."""

from typing import TYPE_CHECKING, Annotated, Any

import typer

from jointplay.command_line import connection
from jointplay.command_line.output import AS_JSON, print_json

if TYPE_CHECKING:
    from jointplay.client import Job


def show(
    results: connection.RESULTS,
    wait: Annotated[bool, typer.Option("--wait", help="Wait until the job is finished.")] = False,
    document: Annotated[
        bool, typer.Option("--job", help="Print the job's document, every default filled in.")
    ] = False,
    as_json: AS_JSON = False,
    url: connection.URL = connection.DEFAULT_URL,
) -> None:
    """Show a job: its state, what it cost, the peaks of its channels; a study's points.

    Example: `jointplay show 01M7YCD368E9VM5RM0B9JY3SGA --job > job.json`
    """
    from jointplay.command_line.accuracy import print_accuracy
    from jointplay.command_line.certificate import print_headline
    from jointplay.command_line.connection import wait_for
    from jointplay.command_line.study_summary import print_points, summary_of

    with connection.job_of(results, url) as job:
        if wait:
            wait_for(job)
        if document:
            print_json(job.job)
            return
        found = _results(job)
        if as_json:
            points = found.pop("points")
            shown = found | {"points": None if points is None else summary_of(points)}
            print_json({"job": job.to_document(), **shown})
        else:
            _print_record(job)
            if job.is_finished and not any(found.values()):
                typer.echo("Nothing was computed.")
            _print_simulation(found)
            if found["statistics"] is not None and job.job.get("certificate"):
                print_headline(job)
            if found["points"] is not None:
                print_points(found["points"])
            if found["accuracy"] is not None:
                print_accuracy(found["accuracy"])
    if wait:
        job.check()


def _results(job: "Job") -> dict[str, Any]:
    """Return what is there so far: statistics and peaks, or the points of a study."""
    from jointplay.client import NotFound, ResultsNotReady
    from jointplay.command_line.peaks import rows_of

    found: dict[str, Any] = {"statistics": None, "peaks": None, "points": None}
    found["accuracy"] = None
    try:
        if "accuracy" in job.links:
            found["accuracy"] = job.accuracy
        elif job.is_study:
            found["points"] = job.study(sections=(0, 1))
        elif job.is_finished:
            found["statistics"] = job.statistics
            found["peaks"] = rows_of(job.results.peaks())
    except (ResultsNotReady, NotFound):
        pass
    return found


def _print_record(job: "Job") -> None:
    typer.echo(f"{job.id}  {job.kind}  {job.label or ''}".rstrip())
    typer.echo(f"state     {job.state}, {job.done_so_far}")
    typer.echo(f"attempt   {job.attempt}")
    typer.echo(f"created   {job.created.astimezone():%Y-%m-%d %H:%M:%S}")
    if job.seconds is not None:
        typer.echo(f"computed  {job.seconds:.2f} s")
    typer.echo(f"solver    {job.solver_version}")
    if job.error is not None:
        typer.echo(f"error     {job.error.error_class}: {job.error.detail}")


def _print_simulation(found: dict[str, Any]) -> None:
    from jointplay.command_line.peaks import print_peaks

    statistics = found["statistics"] or {}
    if statistics.get("steps") is not None:
        counts = [f"{statistics[name]} {name}" for name in ("steps", "rejections", "onsets")]
        typer.echo(f"effort    {', '.join(counts)}")
    if (energy := statistics.get("energy")) is not None:
        work = f"driver work {energy['driver_work']:.4g} J"
        typer.echo(f"energy    {work}, residual {energy['residual']:.2g} J")
    print_peaks(found["peaks"] or [])
