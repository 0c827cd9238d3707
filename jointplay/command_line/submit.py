"""``jointplay submit``: give a job to a service."""

from dataclasses import asdict
from typing import Annotated, Any

import typer

from jointplay.command_line import connection, job_document
from jointplay.command_line.job_options import with_job_options
from jointplay.command_line.output import AS_JSON, print_json


@with_job_options()
def submit(
    source: job_document.JOB,
    settings: job_document.SET = None,
    anew: Annotated[
        bool, typer.Option("--anew", help="Compute it even if an identical job is there.")
    ] = False,
    estimate: Annotated[
        bool, typer.Option("--estimate", help="Only say what it will cost; queue nothing.")
    ] = False,
    wait: Annotated[bool, typer.Option("--wait", help="Wait until the job is finished.")] = False,
    as_json: AS_JSON = False,
    url: connection.URL = connection.DEFAULT_URL,
    **options: Any,
) -> None:
    """Queue a job at a service and print its id; an identical one is not computed again.

    With --wait the exit code tells how the job ended: 0 succeeded, 3 failed, 4 cancelled.

    Examples: `jointplay submit seven-bar-press --set clearance=3e-4 --duration 2 --wait`,
    `jointplay submit seven-bar-press --bifurcation clearance=1e-4:1e-3:200 --wait`
    """
    from jointplay.command_line.connection import wait_for
    from jointplay.command_line.estimate import print_estimate

    job = job_document.job_document(source, settings=settings, options=options)
    if anew:
        job["cache"] = False
    with connection.connect(url) as client:
        if estimate:
            cost = client.estimate(job)
            print_json(asdict(cost)) if as_json else print_estimate(cost)
            return
        queued = client.submit(job)
        if not as_json:
            typer.echo(queued.id)
        if wait:
            wait_for(queued)
        if as_json:
            print_json(queued.to_document())
        if wait:
            queued.check()
