"""``jointplay batch``: many jobs of a service at once."""

from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from jointplay.command_line import connection
from jointplay.command_line.exits import Exit, Stopped
from jointplay.command_line.output import AS_JSON, print_json

if TYPE_CHECKING:
    from jointplay.client import Batch


def batch(
    source: Annotated[
        str,
        typer.Argument(
            metavar="FILE|ID",
            help='A list of job documents as JSON, or {"jobs": [...]}; or the id of a batch.',
        ),
    ],
    label: Annotated[str | None, typer.Option(help="A name of your own for the batch.")] = None,
    cancel: Annotated[bool, typer.Option("--cancel", help="Cancel the batch of this id.")] = False,
    wait: Annotated[bool, typer.Option("--wait", help="Wait until all jobs are finished.")] = False,
    as_json: AS_JSON = False,
    url: connection.URL = connection.DEFAULT_URL,
) -> None:
    """Queue all jobs of a file at a service, or none; or look at a batch by its id.

    With --wait the exit code tells how the jobs ended: 0 all succeeded, 3 some failed, 4 some were
    cancelled.  `jointplay ls --batch ID` lists the jobs.

    Example: `jointplay batch jobs.json --label "friction" --wait`
    """
    from jointplay.records.job_id import is_job_id

    with connection.connect(url) as client:
        known = is_job_id(source) and not Path(source).exists()
        if known:
            found = client.batch(source)
            if cancel:
                found.cancel()
        elif cancel:
            raise Stopped(Exit.BAD_INPUT, "--cancel takes the id of a batch.")
        else:
            jobs, own_label = _jobs_in(Path(source))
            found = client.submit_batch(jobs, label if label is not None else own_label)
            if not as_json:
                typer.echo(found.id)
        if wait:
            _wait_for(found)
    if as_json:
        print_json(found.to_document())
    elif known or wait:
        typer.echo(found.states)
    if wait:
        _exit_of(found)


def _jobs_in(path: Path) -> tuple[list[Any], str]:
    """Return the jobs of a file, and the label that it gives them; the service checks both."""
    from jointplay.records.strict_json import parse

    document = parse(path.read_bytes())
    if isinstance(document, dict) and isinstance(document.get("jobs"), list):
        return document["jobs"], document.get("label", "")
    if not isinstance(document, list):
        line = f"{path}: a batch is a list of jobs, or an object with a list of 'jobs'."
        raise Stopped(Exit.BAD_INPUT, line)
    return document, ""


def _wait_for(found: "Batch") -> None:
    from jointplay.progress import progress

    with progress(found.label or found.id) as report:
        try:
            found.wait(report=lambda batch: report(batch.fraction, batch.states))
        except KeyboardInterrupt:
            line = f"stopped waiting; the jobs go on: jointplay batch --wait {found.id}"
            raise Stopped(Exit.INTERRUPTED, line) from None


def _exit_of(found: "Batch") -> None:
    counts = Counter(found.counts)
    if counts["failed"]:
        raise Stopped(Exit.FAILED, f"{counts['failed']} of {found.size} jobs failed")
    if counts["cancelled"]:
        raise Stopped(Exit.CANCELLED, f"{counts['cancelled']} of {found.size} jobs were cancelled")
