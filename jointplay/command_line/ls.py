"""``jointplay ls``: the jobs of a service."""

from datetime import datetime
from itertools import islice
from typing import Annotated, Any

import typer

from jointplay.command_line import connection


def ls(
    count: Annotated[
        int, typer.Option("-n", "--count", min=1, help="Show at most so many jobs.")
    ] = 20,
    state: Annotated[
        str | None, typer.Option(help="Only jobs in this state, such as running.")
    ] = None,
    kind: Annotated[str | None, typer.Option(help="Only jobs of this kind.")] = None,
    label: Annotated[str | None, typer.Option(help="Only jobs with exactly this label.")] = None,
    scene: Annotated[str | None, typer.Option(help="Only jobs of this preset or scene.")] = None,
    since: Annotated[
        datetime | None, typer.Option(help="Only jobs submitted from this moment on.")
    ] = None,
    before: Annotated[
        datetime | None, typer.Option(help="Only jobs submitted before this moment.")
    ] = None,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print one JSON object for each job.")
    ] = False,
    url: connection.URL = connection.DEFAULT_URL,
) -> None:
    """List the jobs of a service, newest first: id, state, progress, when, kind, label.

    Example: `jointplay ls -n 50 --state failed --scene seven-bar-press`
    """
    import json

    chosen = {"state": state, "kind": kind, "label": label, "scene": scene}
    with connection.connect(url) as client:
        for job in islice(client.jobs(**chosen, since=since, before=before), count):
            if as_json:
                typer.echo(json.dumps(job.to_document()))
                continue
            created = job.created.astimezone().strftime("%Y-%m-%d %H:%M:%S")
            done = f"{job.progress.fraction:.0%}"
            label_or_scene = job.label or scene_name(job.job)
            row = f"{job.id}  {job.state:10} {done:>4}  {created}  {job.kind:11}"
            typer.echo(f"{row}  {label_or_scene}")


def scene_name(job: dict[str, Any]) -> str:
    """Return the name of the scene that a job document simulates."""
    scene = job["scene"]
    return str(scene.get("preset") or scene.get("name"))
