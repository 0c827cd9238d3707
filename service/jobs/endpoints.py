"""``/v1/jobs``: submit, list, look at and cancel jobs."""

from typing import Annotated

from fastapi import APIRouter, Query, Response

from service.body import JsonDocument
from service.dependencies import NO_PARAMETERS, CatalogueDependency, JobOfThePath
from service.jobs.paging import PageQuery
from service.jobs.schemas import JobPage, JobResource, address
from service.jobs.submission import REQUEST_BODY, submit
from service.problems import kinds, problems

router = APIRouter(prefix="/v1/jobs", tags=["jobs"])


@router.post(
    "",
    status_code=202,
    openapi_extra={"requestBody": REQUEST_BODY},
    responses=problems(
        kinds.MALFORMED_JSON,
        kinds.BODY_TOO_LARGE,
        kinds.NOT_JSON,
        kinds.INVALID_JOB,
        kinds.LIMIT_EXCEEDED,
    ),
)
def submit_job(
    document: JsonDocument, catalogue: CatalogueDependency, response: Response
) -> JobResource:
    """Queue a job.

    The whole document is checked first: what is accepted here will not fail later for a reason
    that could have been seen now.  The answer shows every default that was filled in.
    """
    job = submit(catalogue, document)
    response.headers["Location"] = address(job.id)
    return JobResource.of(job)


@router.get("", responses=problems(kinds.INVALID_REQUEST))
def list_jobs(catalogue: CatalogueDependency, query: Annotated[PageQuery, Query()]) -> JobPage:
    """List the jobs, newest first; jobs that arrive in the meantime move no page."""
    page = catalogue.jobs(limit=query.page_size, after=query.checked_token())
    return JobPage(jobs=[JobResource.of(job) for job in page.jobs], next_page_token=page.next)


@router.get(
    "/{job_id}",
    dependencies=[NO_PARAMETERS],
    responses=problems(kinds.UNKNOWN_JOB, kinds.INVALID_REQUEST),
)
def show_job(job: JobOfThePath) -> JobResource:
    """Show one job as it is now."""
    return JobResource.of(job)


@router.post("/{job_id}/cancel", status_code=202, responses=problems(kinds.UNKNOWN_JOB))
def cancel_job(job: JobOfThePath, catalogue: CatalogueDependency) -> JobResource:
    """Ask for a job to be cancelled.

    A running job becomes `cancelling` and ends within about a second; what it computed stays
    readable.  Asking again, or for a finished job, changes nothing.
    """
    return JobResource.of(catalogue.request_cancel(job.id))
