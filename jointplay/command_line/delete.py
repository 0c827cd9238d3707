"""``jointplay delete``: remove finished jobs of a service."""

from typing import Annotated

import typer

from jointplay.command_line.options import AS_JSON, DEFAULT_URL, URL, connect
from jointplay.command_line.output import print_json


def delete(
    job_ids: Annotated[list[str], typer.Argument(metavar="ID...", help="Ids of finished jobs.")],
    as_json: AS_JSON = False,
    url: URL = DEFAULT_URL,
) -> None:
    """Delete finished jobs and their results; there is no way back.

    Example: `jointplay delete 01M7YCD368E9VM5RM0B9JY3SGA`
    """
    with connect(url) as client:
        for job_id in job_ids:
            client.job(job_id).delete()
            if not as_json:
                typer.echo(f"{job_id}  deleted")
    if as_json:
        print_json({"deleted": job_ids})
