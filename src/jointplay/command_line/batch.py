"""``jointplay batch``: many jobs of a service at once."""

from collections import Counter
from collections.abc import Iterator, Sequence
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from jointplay.command_line.exits import Exit, Stopped
from jointplay.command_line.job_document import replaced_numbers
from jointplay.command_line.options import AS_JSON, DEFAULT_URL, URL, connect
from jointplay.command_line.output import print_result, remark

if TYPE_CHECKING:
    from jointplay.client import Batch


_MOST_LISTED = 50


def batch(
    source: Annotated[
        str | None,
        typer.Argument(
            metavar="[FILE|ID]",
            help='A list of job documents as JSON, or {"jobs": [...]}; or the id of a batch.',
        ),
    ] = None,
    label: Annotated[str | None, typer.Option(help="A name of your own for the batch.")] = None,
    cancel: Annotated[bool, typer.Option("--cancel", help="Cancel the batch of this id.")] = False,
    wait: Annotated[bool, typer.Option("--wait", help="Wait until all jobs are finished.")] = False,
    as_json: AS_JSON = False,
    url: URL = DEFAULT_URL,
) -> None:
    """Queue all jobs of a file at a service, or none; or look at a batch by its id, or list all.

    With --wait the exit code tells how the jobs ended: 0 all succeeded, 3 some failed, 4 some were
    cancelled.  `jointplay ls --batch ID` lists the jobs.

    Example: `jointplay batch jobs.json --label "friction" --wait`
    """
    from jointplay.records.job import is_job_id

    with connect(url) as client:
        if source is None:
            if wait or cancel or label is not None:
                raise Stopped("--wait, --cancel and --label are of one batch; give its file or id.")
            listed = list(islice(client.batches(), _MOST_LISTED))
            document = {"batches": [one.to_document() for one in listed]}
            print_result(document, (f"{one.id}  {one.states}" for one in listed), as_json=as_json)
            return
        known = is_job_id(source) and not Path(source).exists()
        if known:
            if label is not None:
                raise Stopped("--label is of a batch that is queued now; leave it out.")
            found = client.batch(source)
            if cancel:
                found.cancel()
        elif cancel:
            raise Stopped("--cancel takes the id of a batch.")
        else:
            jobs, own_label = _jobs_in(Path(source))
            found = client.submit_batch(jobs, label if label is not None else own_label)
            remark(_replaced(jobs))
            if not as_json:
                typer.echo(found.id)
        if wait:
            _wait_for(found)
    print_result(found.to_document(), [found.states] if known or wait else [], as_json=as_json)
    if wait:
        _check(found)


def _jobs_in(path: Path) -> tuple[list[Any], str]:
    """Return the jobs of a file, and the label that it gives them; the service checks both."""
    from jointplay.records.strict_json import parse

    document = parse(path.read_bytes())
    label = ""
    if isinstance(document, dict):
        label, document = document.get("label", ""), document.get("jobs")
    if not isinstance(document, list):
        raise Stopped(f"{path}: a batch is a list of jobs, or an object with a list of 'jobs'.")
    for index, job in enumerate(document):
        if not isinstance(job, dict):
            raise Stopped(f"{path}: /jobs/{index}: a job is a JSON object.")
    return document, label


def _replaced(jobs: Sequence[Any]) -> Iterator[str]:
    """Yield a line for every number that the default of a parameter replaces in jobs of a batch."""
    lines = Counter(line for job in jobs for line in replaced_numbers(job, None))
    for line, count in lines.items():
        yield f"in {count} of {len(jobs)} jobs {line}"


def _wait_for(found: "Batch") -> None:
    from jointplay.progress import progress

    with progress(found.label or found.id) as report:
        try:
            found.wait(report=lambda batch: report(batch.fraction, batch.states))
        except KeyboardInterrupt:
            line = f"stopped waiting; the jobs go on: jointplay batch --wait {found.id}"
            raise Stopped(line, Exit.INTERRUPTED) from None


def _check(found: "Batch") -> None:
    for state, words, code in (
        ("failed", "failed", Exit.FAILED),
        ("cancelled", "were cancelled", Exit.CANCELLED),
    ):
        if count := found.counts.get(state):
            raise Stopped(f"{count} of {found.size} jobs {words}", code)
