"""``jointplay show``: one job of a service."""

from typing import Annotated

import typer

from jointplay.command_line import connection


def show(
    job_id: Annotated[str, typer.Argument(metavar="ID", help="Id of the job.")],
    wait: Annotated[bool, typer.Option("--wait", help="Wait until the job is finished.")] = False,
    document: Annotated[
        bool, typer.Option("--job", help="Print the job's document, every default filled in.")
    ] = False,
    url: connection.URL = connection.DEFAULT_URL,
) -> None:
    """Show a job: its state, once it is finished the peaks of its channels; a study's points.

    Example: `jointplay show 01M7YCD368E9VM5RM0B9JY3SGA --job > job.json`
    """
    import json

    from jointplay.client import NotFound, ResultsNotReady
    from jointplay.command_line.peaks import of_service, print_peaks
    from jointplay.command_line.study_summary import print_points
    from jointplay.command_line.waiting import done_so_far, exit_of, wait_for

    with connection.connect(url) as client:
        job = wait_for(client, job_id, job_id) if wait else client.get(job_id)
        if document:
            typer.echo(json.dumps(job.job, indent=2))
            return
        typer.echo(f"{job.id}  {job.kind}  {job.label or ''}".rstrip())
        typer.echo(f"state     {job.state}, {done_so_far(job)}")
        typer.echo(f"attempt   {job.attempt}")
        typer.echo(f"created   {job.created.astimezone():%Y-%m-%d %H:%M:%S}")
        if job.started and job.finished:
            typer.echo(f"computed  {(job.finished - job.started).total_seconds():.2f} s")
        typer.echo(f"solver    {job.solver_version}")
        if job.error is not None:
            typer.echo(f"error     {job.error.kind}: {job.error.detail}")
        try:
            if job.kind != "simulate":
                print_points(client.study(job_id, sections=(0, 1)))
            elif job.is_finished:
                if (energy := client.statistics(job_id)["energy"]) is not None:
                    work = f"driver work {energy['driver_work']:.4g} J"
                    typer.echo(f"energy    {work}, residual {energy['residual']:.2g} J")
                print_peaks(of_service(client.peaks(job_id)))
        except ResultsNotReady:
            pass
        except NotFound:
            typer.echo("Nothing was computed.")
    if wait:
        exit_of(job)
