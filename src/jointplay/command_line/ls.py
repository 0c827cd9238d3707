"""``jointplay ls``: the jobs of a service."""

from datetime import datetime
from itertools import islice
from typing import TYPE_CHECKING, Annotated

import typer

from jointplay.command_line.chosen_jobs import KIND, LABEL, SCENE, Filters, refuse_empty
from jointplay.command_line.exits import Stopped
from jointplay.command_line.options import AS_JSON, DEFAULT_URL, URL, connect
from jointplay.command_line.output import print_result, visible

if TYPE_CHECKING:
    from jointplay.client import Job


def ls(
    count: Annotated[int, typer.Option("-n", "--count", min=1, help="Most jobs to show.")] = 20,
    state: Annotated[
        str | None, typer.Option(help="Only jobs in this state, such as running.")
    ] = None,
    kind: KIND = None,
    label: LABEL = None,
    scene: SCENE = None,
    since: Annotated[
        datetime | None, typer.Option(help="Only jobs submitted from this moment on.")
    ] = None,
    before: Annotated[
        datetime | None, typer.Option(help="Only jobs submitted before this moment.")
    ] = None,
    batch: Annotated[
        str | None, typer.Option(metavar="ID", help="The jobs of a batch, in their order.")
    ] = None,
    as_json: AS_JSON = False,
    url: URL = DEFAULT_URL,
) -> None:
    """List the jobs of a service, newest first: id, state, progress, when, kind, label.

    In brackets is what a job waits for, or is busy with before it advances.

    Example: `jointplay ls -n 50 --state failed --scene seven-bar-press`
    """
    chosen = Filters(state, kind, label, scene)
    refuse_empty(None, batch, chosen)
    if batch is not None and (chosen.given or since or before):
        raise Stopped("--batch lists all jobs of a batch; leave the filters out.")
    with connect(url) as client:
        if batch is None:
            found = client.jobs(**chosen._asdict(), since=since, before=before)
        else:
            found = client.batch(batch).jobs()
        jobs = list(islice(found, count))
    print_result({"jobs": [job.to_document() for job in jobs]}, map(_row, jobs), as_json=as_json)


def _row(job: "Job") -> str:
    created = job.created.astimezone().strftime("%Y-%m-%d %H:%M:%S")
    done = f"{job.progress.fraction:.0%}"
    row = f"{job.id}  {job.state:10} {done:>4}  {created}  {job.kind:15}"
    row += f"  {visible(', '.join(job.labels) or job.scene_name, kept='')}"
    return row if job.is_finished or job.activity is None else f"{row}  ({job.activity})"
