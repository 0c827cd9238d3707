"""``jointplay cancel``: stop a job of a service."""

from typing import Annotated

import typer

from jointplay.command_line import connection
from jointplay.command_line.output import AS_JSON, print_json


def cancel(
    job_id: Annotated[str, typer.Argument(metavar="ID", help="Id of the job.")],
    as_json: AS_JSON = False,
    url: connection.URL = connection.DEFAULT_URL,
) -> None:
    """Ask for a job to be cancelled; what it has computed stays readable.

    Asking again, or for a finished job, changes nothing.

    Example: `jointplay cancel 01M7YCD368E9VM5RM0B9JY3SGA`
    """
    with connection.connect(url) as client:
        job = client.job(job_id).cancel()
    if as_json:
        print_json(job.to_document())
    else:
        typer.echo(f"{job_id}  {job.state}")
