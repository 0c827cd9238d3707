"""``jointplay delete``: remove finished jobs of a service."""

from typing import Annotated

import typer

from jointplay.command_line.chosen_jobs import (
    BATCH,
    IDS,
    KIND,
    LABEL,
    SCENE,
    YES,
    Filters,
    agree,
    chosen,
    refuse_empty,
)
from jointplay.command_line.options import AS_JSON, DEFAULT_URL, URL, connect
from jointplay.command_line.output import print_json, print_result

_FINISHED = ("succeeded", "failed", "cancelled")


def delete(
    job_ids: IDS = None,
    batch: BATCH = None,
    state: Annotated[
        str | None, typer.Option(help="Only jobs in this state: succeeded, failed or cancelled.")
    ] = None,
    kind: KIND = None,
    label: LABEL = None,
    scene: SCENE = None,
    yes: YES = False,
    as_json: AS_JSON = False,
    url: URL = DEFAULT_URL,
) -> None:
    """Delete finished jobs and their results; there is no way back.

    With --batch alone the whole batch is deleted, once all its jobs have ended.  Jobs that are not
    named by their ids are counted, and deleted after a question, or with --yes.

    Example: `jointplay delete --state failed --scene seven-bar-press`
    """
    filters = Filters(state, kind, label, scene)
    refuse_empty(job_ids, batch, filters)
    with connect(url) as client:
        if batch is not None and not (job_ids or filters.given):
            whole = client.batch(batch)
            agree(f"Delete batch {batch} with its {whole.size} jobs and their results?", yes=yes)
            whole.delete()
            print_result(
                whole.to_document(), [f"{batch}  deleted with {whole.size} jobs"], as_json=as_json
            )
            return
        jobs = chosen(client, job_ids, batch, filters, _FINISHED)
        if jobs and not job_ids:
            agree(f"Delete {len(jobs)} jobs and their results?", yes=yes)
        deleted: list[str] = []
        try:
            for job in jobs:
                job.delete()
                deleted.append(job.id)
                if not as_json:
                    typer.echo(f"{job.id}  deleted")
        finally:  # also what was done before one that cannot be deleted
            if as_json:
                print_json({"deleted": deleted})
