"""``jointplay retry``: have jobs of a service computed anew that failed or were cancelled."""

from typing import Annotated

import typer

from jointplay.command_line.chosen_jobs import (
    BATCH,
    IDS,
    KIND,
    LABEL,
    SCENE,
    Filters,
    chosen,
    refuse_empty,
)
from jointplay.command_line.options import AS_JSON, DEFAULT_URL, URL, connect
from jointplay.command_line.output import print_json, print_result

_UNSUCCESSFUL = ("failed", "cancelled")


def retry(
    job_ids: IDS = None,
    batch: BATCH = None,
    state: Annotated[
        str | None, typer.Option(help="Only jobs in this state: failed or cancelled.")
    ] = None,
    kind: KIND = None,
    label: LABEL = None,
    scene: SCENE = None,
    as_json: AS_JSON = False,
    url: URL = DEFAULT_URL,
) -> None:
    """Queue jobs that failed or were cancelled once more, as new jobs; print old and new ids.

    With --batch alone they are queued as one new batch, whose id is printed.  Asking again finds
    what the first time made.

    Example: `jointplay retry --state failed --scene seven-bar-press`
    """
    filters = Filters(state, kind, label, scene)
    refuse_empty(job_ids, batch, filters)
    with connect(url) as client:
        if batch is not None and not (job_ids or filters.given):
            made = client.batch(batch).retry()
            print_result(made.to_document(), [f"{made.id}  {made.states}"], as_json=as_json)
            return
        jobs = chosen(client, job_ids, batch, filters, _UNSUCCESSFUL)
        retried: dict[str, str] = {}
        try:
            for job in jobs:
                retried[job.id] = job.retry().id
                if not as_json:
                    typer.echo(f"{job.id}  retried as {retried[job.id]}")
        finally:  # also what was done before one that cannot be retried
            if as_json:
                print_json({"retried": retried})
