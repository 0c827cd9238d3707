"""``/v1/batches``: submit, look at, cancel, retry and delete many jobs at once."""

from contextlib import suppress
from typing import Annotated, Any, Self

from fastapi import APIRouter, Depends, Path, Query, Response
from pydantic import BaseModel, Field

from jointplay.records.job import is_job_id
from jointplay.service.access import CallerDependency
from jointplay.service.body import BatchBody
from jointplay.service.dependencies import CatalogueDependency
from jointplay.service.fair_semaphore import in_turn
from jointplay.service.idempotency import RepeatableRequest
from jointplay.service.jobs.listing import PageQuery
from jointplay.service.jobs.queueing import QueueingDependency
from jointplay.service.jobs.schemas import JobPage, Moment
from jointplay.service.problems import RequestRefused, clipped, header, kinds, problems
from jointplay.storage.catalogue.errors import BatchNotFound
from jointplay.storage.catalogue.records import Batch, JobState, SubmittedBatch

router = APIRouter(prefix="/v1/batches", tags=["batches"])

REQUEST_BODY = {
    "required": True,
    "description": "The jobs; each as it is sent to /v1/jobs.",
    "content": {"application/json": {"schema": {"$ref": "#/components/schemas/BatchDocument"}}},
}
MADE: dict[int | str, dict[str, Any]] = {
    202: {"headers": {"Location": header("Path of the batch.")}}
}
BatchId = Annotated[str, Path(description="Id of the batch, as POST /v1/batches returned it.")]


class BatchProgress(BaseModel):
    """Progress of the whole batch."""

    fraction: float = Field(ge=0, le=1, description="0 to 1, every job weighing the same.")


class BatchResource(BaseModel):
    """Jobs that were submitted together."""

    id: str
    label: str | None
    created: Moment
    jobs: int = Field(description="Number of jobs.")
    states: dict[JobState, int] = Field(description="How many jobs are in each state.")
    progress: BatchProgress
    finished: bool = Field(description="Whether all jobs have ended, however they did.")
    links: dict[str, str] = Field(description="Addresses of the batch and of its jobs.")

    @classmethod
    def of(cls, batch: Batch, **more: Any) -> Self:
        """Show the catalogue's record."""
        base = f"{router.prefix}/{batch.id}"
        shown = {
            "jobs": batch.count,
            "progress": {"fraction": batch.fraction},
            "finished": batch.finished,
            "links": {"self": base}
            | {name: f"{base}/{name}" for name in ("jobs", "cancel", "retry")},
        }
        return cls.model_validate(vars(batch) | shown | more)


class AcceptedBatch(BatchResource):
    """A batch that was just queued."""

    job_ids: list[str] = Field(description="Ids of its jobs, in the order of the request.")


def _batch_of_the_path(
    catalogue: CatalogueDependency, caller: CallerDependency, batch_id: BatchId
) -> Batch:
    with suppress(BatchNotFound):
        if is_job_id(batch_id) and caller.sees((batch := catalogue.batch(batch_id)).owner):
            return batch
    sentence = f"There is no batch {clipped(batch_id)!r}."
    raise RequestRefused.of_parameter("batch_id", sentence, kinds.UNKNOWN_BATCH)


BatchOfThePath = Annotated[Batch, Depends(_batch_of_the_path)]


@router.post(
    "",
    status_code=202,
    openapi_extra={"requestBody": REQUEST_BODY},
    responses=MADE | problems(*kinds.OF_SUBMISSIONS),
)
def submit_batch(
    queueing: QueueingDependency,
    body: BatchBody,
    repeatable: RepeatableRequest,
    caller: CallerDependency,
    response: Response,
) -> AcceptedBatch:
    """Queue up to 10 000 jobs, or none.

    All are checked first; if any cannot be run, nothing is queued and `errors` points at each
    wrong field by the index of its job, such as `/jobs/17/duration`.
    """
    submitted = queueing.submit_batch(body, repeatable, caller)
    return _accepted(submitted, response)


def _accepted(submitted: SubmittedBatch, response: Response) -> AcceptedBatch:
    accepted = AcceptedBatch.of(submitted.batch, job_ids=submitted.jobs)
    response.headers["Location"] = accepted.links["self"]
    return accepted


class BatchPage(BaseModel):
    """Batches, newest first."""

    batches: list[BatchResource]
    next_page_token: str | None = Field(
        description="Give it as page_token for the batches after these; null: there are no more."
    )


@router.get("", responses=problems(kinds.INVALID_REQUEST))
def list_batches(
    catalogue: CatalogueDependency, caller: CallerDependency, query: Annotated[PageQuery, Query()]
) -> BatchPage:
    """List batches, newest first; batches that arrive in the meantime move no page."""
    owner = None if caller.sees_all else caller.owner
    found, following = catalogue.page_of_batches(
        limit=query.page_size, after=query.checked_token(), owner=owner
    )
    return BatchPage(
        batches=[BatchResource.of(batch) for batch in found], next_page_token=following
    )


@router.get(
    "/{batch_id}",
    responses=problems(kinds.UNKNOWN_BATCH, kinds.INVALID_REQUEST),
)
def show_batch(batch: BatchOfThePath) -> BatchResource:
    """Show a batch: how many of its jobs are in each state, and the progress of the whole."""
    return BatchResource.of(batch)


@router.get(
    "/{batch_id}/jobs",
    responses=problems(kinds.UNKNOWN_BATCH, kinds.INVALID_REQUEST),
    dependencies=[in_turn("listing")],
)
def list_jobs_of_batch(
    batch: BatchOfThePath, catalogue: CatalogueDependency, query: Annotated[PageQuery, Query()]
) -> JobPage:
    """List the jobs of a batch, in the order in which they were submitted."""
    page = catalogue.jobs(
        limit=query.page_size, after=query.checked_token(), batch=batch.id, oldest_first=True
    )
    return JobPage.of(page)


@router.post("/{batch_id}/cancel", status_code=202, responses=problems(kinds.UNKNOWN_BATCH))
def cancel_batch(batch: BatchOfThePath, catalogue: CatalogueDependency) -> BatchResource:
    """Ask for every job of a batch that is not finished to be cancelled.

    What they computed stays readable.  Asking again changes nothing.
    """
    return BatchResource.of(catalogue.cancel_batch(batch.id))


@router.post(
    "/{batch_id}/retry",
    status_code=202,
    responses=MADE | problems(kinds.UNKNOWN_BATCH, *kinds.OF_RETRIES),
)
def retry_batch(
    batch: BatchOfThePath,
    queueing: QueueingDependency,
    caller: CallerDependency,
    response: Response,
) -> AcceptedBatch:
    """Queue those jobs of a batch once more that failed or were cancelled, as a new batch.

    The new batch has the label of this one, and each of its jobs names the one that it repeats as
    POST /v1/jobs/{id}/retry does.  Jobs that were retried before are left out.  Asked again within
    24 hours, the answer is the same batch, unless more jobs have failed meanwhile.
    """
    return _accepted(queueing.retry_batch(batch, caller), response)


@router.delete("/{batch_id}", responses=problems(kinds.UNKNOWN_BATCH, kinds.NOT_FINISHED))
def delete_batch(batch: BatchOfThePath, catalogue: CatalogueDependency) -> BatchResource:
    """Delete a finished batch with all its jobs and their results; the answer is what it was.

    It is refused while one of the jobs has not ended: cancel the batch first.  From then on the
    addresses of the jobs answer 410, and that of the batch 404.
    """
    return BatchResource.of(catalogue.delete_batch(batch.id))
