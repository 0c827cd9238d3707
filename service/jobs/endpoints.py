"""``/v1/jobs``: submit, list, look at and cancel jobs."""

from typing import Annotated

from fastapi import APIRouter, Query, Response

from service.body import JsonDocument
from service.dependencies import JOB_ID, CatalogueDependency, JobOfThePath
from service.jobs.schemas import JobPage, JobResource, address
from service.jobs.submission import REQUEST_BODY, submit
from service.problems import ErrorDetail, RequestRefused, kinds, problems

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
def list_jobs(
    catalogue: CatalogueDependency,
    page_size: Annotated[int, Query(ge=1, le=1000, description="Most jobs in one page.")] = 50,
    page_token: Annotated[
        str | None, Query(description="next_page_token of the page before.")
    ] = None,
) -> JobPage:
    """List the jobs, newest first; jobs that arrive in the meantime move no page."""
    if page_token is not None and not JOB_ID.fullmatch(page_token):
        sentence = "Give the next_page_token of a page, or leave it out."
        raise RequestRefused(
            kinds.INVALID_REQUEST,
            "The page_token is not one that this service gave.",
            [ErrorDetail(parameter="page_token", detail=sentence)],
        )
    page = catalogue.jobs(limit=page_size, after=page_token)
    return JobPage(jobs=[JobResource.of(job) for job in page.jobs], next_page_token=page.next)


@router.get("/{job_id}", responses=problems(kinds.UNKNOWN_JOB))
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
