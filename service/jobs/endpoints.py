"""``/v1/jobs``: submit, list, look at, cancel and delete jobs."""

from typing import Annotated, Any

from fastapi import APIRouter, Query, Response
from fastapi.concurrency import run_in_threadpool

from jointplay.service.access import CallerDependency
from jointplay.service.body import JobBody
from jointplay.service.dependencies import CatalogueDependency, JobOfThePath
from jointplay.service.fair_semaphore import in_turn
from jointplay.service.idempotency import RepeatableRequest
from jointplay.service.jobs.listing import JobQuery
from jointplay.service.jobs.queueing import QueueingDependency
from jointplay.service.jobs.schemas import JobPage, JobResource, SubmittedJob, address
from jointplay.service.jobs.submission import REQUEST_BODY
from jointplay.service.jobs.waiting import PatienceDependency, WaitQuery
from jointplay.service.problems import header, kinds, problems

router = APIRouter(prefix="/v1/jobs", tags=["jobs"])
_LOCATION = {"headers": {"Location": header("Path of the job.")}}
MADE_OR_FOUND: dict[int | str, dict[str, Any]] = {
    200: {
        "model": SubmittedJob,
        "description": "An identical job was there, or the job was waited for and is finished.",
    }
    | _LOCATION,
    202: _LOCATION,
}


@router.post(
    "",
    status_code=202,
    openapi_extra={"requestBody": REQUEST_BODY},
    responses=MADE_OR_FOUND | problems(*kinds.OF_SUBMISSIONS),
)
async def submit_job(
    queueing: QueueingDependency,
    body: JobBody,
    repeatable: RepeatableRequest,
    patience: PatienceDependency,
    caller: CallerDependency,
    response: Response,
) -> SubmittedJob:
    """Queue a job, or find the one that computes the same.

    The whole document is checked first: what is accepted here will not fail later for a reason
    that could have been seen now.  The answer shows every default that was filled in.  A job that
    equals one that is queued, running or succeeded is not computed again: that one is the answer,
    with 200 and `cached`, unless the document says `"cache": false`.
    """
    submitted = await run_in_threadpool(queueing.submit, body, repeatable, caller)
    job = await patience.finished(submitted.job)
    if submitted.cached or job.state.terminal:
        response.status_code = 200
    response.headers["Location"] = address(job.id)
    return SubmittedJob.of(job, cached=submitted.cached)


@router.get("", responses=problems(kinds.INVALID_REQUEST), dependencies=[in_turn("listing")])
def list_jobs(
    catalogue: CatalogueDependency, caller: CallerDependency, query: Annotated[JobQuery, Query()]
) -> JobPage:
    """List jobs, newest first; jobs that arrive in the meantime move no page."""
    wanted = query.wanted() | {"owner": None if caller.sees_all else caller.owner}
    page = catalogue.jobs(limit=query.page_size, after=query.checked_token(), **wanted)
    return JobPage.of(page)


@router.get("/{job_id}", responses=problems(*kinds.OF_A_JOB, kinds.INVALID_REQUEST))
async def show_job(
    job: JobOfThePath, patience: PatienceDependency, query: Annotated[WaitQuery, Query()]
) -> JobResource:
    """Show one job as it is now, or wait until it is finished."""
    return JobResource.of(await patience.finished(job, query.wait))


@router.post("/{job_id}/cancel", status_code=202, responses=problems(*kinds.OF_A_JOB))
def cancel_job(job: JobOfThePath, catalogue: CatalogueDependency) -> JobResource:
    """Ask for a job to be cancelled.

    A running job becomes `cancelling` and ends within about a second; what it computed stays
    readable.  Asking again, or for a finished job, changes nothing.
    """
    return JobResource.of(catalogue.request_cancel(job.id))


@router.post(
    "/{job_id}/retry",
    status_code=202,
    responses=MADE_OR_FOUND | problems(*kinds.OF_A_JOB, *kinds.OF_RETRIES, *kinds.OF_KEYS),
)
def retry_job(
    job: JobOfThePath,
    queueing: QueueingDependency,
    repeatable: RepeatableRequest,
    caller: CallerDependency,
    response: Response,
) -> SubmittedJob:
    """Queue a job that failed or was cancelled once more.

    What has ended never changes: the document is queued as a new job with the same label, whose
    first event has `retry_of`; an event `retried` of the old job names it.  Asked again, the answer
    is that job, with 200 and `cached`, until it has failed or was cancelled itself; with the same
    Idempotency-Key also after that.
    """
    submitted = queueing.retry(job, repeatable, caller)
    if submitted.cached:
        response.status_code = 200
    response.headers["Location"] = address(submitted.job.id)
    return SubmittedJob.of(submitted.job, cached=submitted.cached)


@router.post("/{job_id}/report-mismatch", responses=problems(*kinds.OF_A_JOB, kinds.NOT_FINISHED))
def report_mismatch(job: JobOfThePath, catalogue: CatalogueDependency) -> JobResource:
    """Note that a repetition of a finished job, as by `jointplay verify`, gave other results.

    They can still be read. The job is marked as `damaged`, so that posting its document computes
    it anew.  Asking again changes nothing.
    """
    return JobResource.of(catalogue.mark_not_reproduced(job.id))


@router.delete("/{job_id}", responses=problems(*kinds.OF_A_JOB, kinds.NOT_FINISHED))
def delete_job(job: JobOfThePath, catalogue: CatalogueDependency) -> JobResource:
    """Delete a finished job and its results; from then on its addresses answer 410."""
    return JobResource.of(catalogue.delete(job.id))
