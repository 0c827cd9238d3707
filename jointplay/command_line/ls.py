"""``jointplay ls``: the jobs of a service."""

from itertools import islice
from typing import Annotated, Any

import typer

from jointplay.command_line import connection


def ls(
    count: Annotated[
        int, typer.Option("-n", "--count", min=1, help="Show at most so many jobs.")
    ] = 20,
    url: connection.URL = connection.DEFAULT_URL,
) -> None:
    """List the jobs of a service, newest first: id, state, progress, when, kind, label.

    Example: `jointplay ls -n 50`
    """
    with connection.connect(url) as client:
        for job in islice(client.jobs(), count):
            created = job.created.astimezone().strftime("%Y-%m-%d %H:%M:%S")
            done = f"{job.progress.fraction:.0%}"
            label = job.label or scene_name(job.job)
            typer.echo(f"{job.id}  {job.state:10} {done:>4}  {created}  {job.kind:11}  {label}")


def scene_name(job: dict[str, Any]) -> str:
    """Return the name of the scene that a job document simulates."""
    scene = job["scene"]
    return str(scene.get("preset") or scene.get("name"))
