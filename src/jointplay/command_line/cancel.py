"""``jointplay cancel``: stop a job of a service."""

from typing import Annotated

import typer

from jointplay.command_line.options import AS_JSON, DEFAULT_URL, URL, connect
from jointplay.command_line.output import print_result


def cancel(
    job_id: Annotated[str, typer.Argument(metavar="ID", help="Id of the job.")],
    as_json: AS_JSON = False,
    url: URL = DEFAULT_URL,
) -> None:
    """Ask for a job to be cancelled; what it has computed stays readable.

    Asking again, or for a finished job, changes nothing.

    Example: `jointplay cancel 01M7YCD368E9VM5RM0B9JY3SGA`
    """
    with connect(url) as client:
        job = client.job(job_id).cancel()
    print_result(job.to_document(), [f"{job_id}  {job.state}"], as_json=as_json)
