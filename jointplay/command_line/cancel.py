"""``jointplay cancel``: stop a job of a service."""

from typing import Annotated

import typer

from jointplay.command_line import connection


def cancel(
    job_id: Annotated[str, typer.Argument(metavar="ID", help="Id of the job.")],
    url: connection.URL = connection.DEFAULT_URL,
) -> None:
    """Ask for a job to be cancelled; what it has computed stays readable.

    Asking again, or for a finished job, changes nothing.

    Example: `jointplay cancel 01M7YCD368E9VM5RM0B9JY3SGA`
    """
    with connection.connect(url) as client:
        typer.echo(f"{job_id}  {client.cancel(job_id).state}")
