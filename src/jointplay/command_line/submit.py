"""``jointplay submit``: give a job to a service."""

from collections.abc import Iterator
from dataclasses import asdict
from typing import TYPE_CHECKING, Annotated, Any

import typer

from jointplay.command_line.job_document import job_document, replaced_numbers
from jointplay.command_line.job_options import with_job_options
from jointplay.command_line.options import (
    AS_JSON,
    DEFAULT_URL,
    JOB,
    SET,
    URL,
    WAIT,
    connect,
    wait_for,
)
from jointplay.command_line.output import print_json, print_result, remark

if TYPE_CHECKING:
    from jointplay.client import Estimate


@with_job_options()
def submit(
    source: JOB,
    settings: SET = None,
    anew: Annotated[
        bool, typer.Option("--anew", help="Compute it even if an identical job is there.")
    ] = False,
    estimate: Annotated[
        bool, typer.Option("--estimate", help="Only say what it will cost; queue nothing.")
    ] = False,
    wait: WAIT = False,
    as_json: AS_JSON = False,
    url: URL = DEFAULT_URL,
    **options: Any,
) -> None:
    """Queue a job at a service and print its id; an identical one is not computed again.

    With --wait the exit code tells how the job ended: 0 succeeded, 3 failed, 4 cancelled.

    Examples: `jointplay submit seven-bar-press --set clearance=3e-4 --duration 2 --wait`,
    `jointplay submit seven-bar-press --bifurcation clearance=1e-4:1e-3:200 --wait`
    """
    job = job_document(source, settings=settings, options=options)
    if anew:
        job["cache"] = False
    with connect(url) as client:
        if estimate:
            cost = client.estimate(job)
            remark(replaced_numbers(job, settings))
            print_result(asdict(cost), _lines(cost), as_json=as_json)
            return
        queued = client.submit(job)
        remark(replaced_numbers(job, settings))
        if not as_json:
            typer.echo(queued.id)
        if wait:
            wait_for(queued)
        if as_json:
            print_json(queued.to_document())
        if wait:
            queued.check()


def _lines(estimate: "Estimate") -> Iterator[str]:
    """Yield time, steps and bytes, and what else is known of a job before it runs."""
    from jointplay.progress import duration

    seconds = estimate.seconds
    time = duration(seconds) if seconds >= 10 else f"{seconds:.2g} s"
    yield f"computing  {time} of one core, {estimate.steps:.3g} steps"
    if estimate.device_seconds is not None:
        yield f"or         {estimate.device_seconds:.2g} s of the workers' graphics processors"
    yield f"results    {estimate.bytes / 1e6:.3g} MB"
    if estimate.points > 1:
        yield f"points     {estimate.points} in {estimate.blocks} blocks"
    if estimate.cached:
        yield "an identical job is there already: submitting it costs nothing"
    if estimate.failure is not None:
        yield f"it will end early: {estimate.failure}"
