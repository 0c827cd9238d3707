"""``jointplay show``: one job, and what became of it."""

from collections.abc import Iterator
from typing import TYPE_CHECKING, Annotated, Any

import typer

from jointplay.command_line.options import (
    AS_JSON,
    DEFAULT_URL,
    RESULTS,
    URL,
    WAIT,
    job_of,
    wait_for,
)
from jointplay.command_line.output import print_json, print_result

if TYPE_CHECKING:
    from jointplay.client import Job


def show(
    results: RESULTS,
    wait: WAIT = False,
    document: Annotated[
        bool, typer.Option("--job", help="Print the job's document, every default filled in.")
    ] = False,
    as_json: AS_JSON = False,
    url: URL = DEFAULT_URL,
) -> None:
    """Show a job: its state, what it cost, the peaks of its channels; a study's points.

    Example: `jointplay show 01M7YCD368E9VM5RM0B9JY3SGA --job > job.json`
    """
    from jointplay.command_line.summary import document_of, results_of

    with job_of(results, url) as job:
        if wait:
            wait_for(job)
        if document:
            print_json(job.job)
        else:
            found = results_of(job)
            print_result(document_of(job, found), _lines(job, found), as_json=as_json)
    if wait:
        job.check()


def _lines(job: "Job", found: dict[str, Any]) -> Iterator[str]:
    from jointplay.command_line.summary import result_lines

    yield f"{job.id}  {job.kind}  {job.label or ''}".rstrip()
    busy = "" if job.is_finished or job.activity is None else f", {job.activity}"
    yield f"state     {job.state}, {job.done_so_far}{busy}"
    yield f"attempt   {job.attempt}"
    yield f"created   {job.created.astimezone():%Y-%m-%d %H:%M:%S}"
    if job.seconds is not None:
        yield f"computed  {job.seconds:.2f} s"
    yield f"solver    {job.solver_version}"
    if job.error is not None:
        yield f"error     {job.error.error_class}: {job.error.detail}"
    if job.damaged is not None:
        again = f"jointplay show {job.id} --job > job.json; jointplay submit job.json"
        yield f"damaged   {job.damaged}; to compute it anew: {again}"
    if job.is_finished and not any(found.values()):
        yield "Nothing was computed."
    statistics = found["statistics"] or {}
    if statistics.get("steps") is not None:
        counts = [f"{statistics[name]} {name}" for name in ("steps", "rejections", "onsets")]
        yield f"effort    {', '.join(counts)}"
    if (energy := statistics.get("energy")) is not None:
        work = f"driver work {energy['driver_work']:.4g} J"
        yield f"energy    {work}, residual {energy['residual']:.2g} J"
    yield from result_lines(job, found)
