"""Jobs as the API shows them."""

from datetime import UTC, datetime
from typing import Annotated, Any, Final, Self

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field

from jointplay.records.job import ErrorClass
from jointplay.service.fields import in_unit
from jointplay.solver.kinds import KINDS
from jointplay.storage.catalogue.records import Job, JobState
from jointplay.storage.catalogue.records import JobPage as Page

_LATEST: Final = datetime(9999, 12, 31, 23, 59, 59, tzinfo=UTC)


def moment(epoch_seconds: float) -> datetime:
    """Return a time of the catalogue as it is shown; what no date can say as the last one."""
    return datetime.fromtimestamp(min(epoch_seconds, _LATEST.timestamp()), UTC)


def _moment_of(value: object) -> object:
    return moment(value) if isinstance(value, float) else value


Moment = Annotated[datetime, BeforeValidator(_moment_of)]
"""A moment, made of the catalogue's epoch seconds."""


class Progress(BaseModel):
    """Progress of a job."""

    time: float = in_unit("s", "Simulated time reached.")
    fraction: float = Field(ge=0, le=1, description="Part of the whole job, 0 to 1.")
    steps: int | None = Field(description="Accepted steps of the solver, as far as they are known.")


class JobError(BaseModel):
    """Reason for which a job failed."""

    model_config = ConfigDict(serialize_by_alias=True, validate_by_name=True)

    error_class: ErrorClass = Field(
        alias="class",
        description="What mends it: another document (user), another tolerance or method (solver), "
        "the operator (platform), a smaller job (limit).",
    )
    code: str = Field(description="The reason for programs, for example step-size-underflow.")
    detail: str = Field(description="The reason, and what to try.")
    time: float | None = in_unit("s", "Simulated time at which it happened.")


class JobResource(BaseModel):
    """One job. Its results can be read while it runs, as far as they are committed."""

    id: str
    kind: str = Field(description="The kind of the job.", examples=[*KINDS])
    label: str | None = Field(description="The one that it was first asked for with.")
    labels: list[str] = Field(
        description="All that it was asked for with, as one request's answer may be another's."
    )
    batch: str | None = Field(description="Id of the batch that the job belongs to.")
    state: JobState
    activity: str | None = Field(
        description="What a job is busy with before it advances, such as compiling."
    )
    progress: Progress
    attempt: int = Field(description="Counts from 1; 0: never started.")
    created: Moment
    started: Moment | None
    finished: Moment | None
    expires: Moment | None = Field(
        description="When the job and its results go; null: they are kept until they are deleted."
    )
    error: JobError | None
    damaged: str | None = Field(
        description="Which file of its results is not what was stored, as far as was noticed, or "
        "that a repetition gave others: posting the document computes the job anew."
    )
    links: dict[str, str] = Field(description="Addresses of the job and of what it computed.")
    job: dict[str, Any] = Field(
        description="The job's document with every default filled in: posting it repeats the job."
    )
    solver_version: str

    @classmethod
    def of(cls, job: Job, **more: Any) -> Self:
        """Show the catalogue's record."""
        progress = {
            "time": job.progress_time,
            "fraction": job.progress_fraction,
            "steps": job.steps,
        }
        error = job.error and job.error.document()
        labels = [one for one in (job.label, *(job.further_labels or ())) if one is not None]
        shown = {
            "labels": labels,
            "progress": progress,
            "error": error,
            "links": _links(job),
            "job": job.spec,
        }
        return cls.model_validate(vars(job) | shown | more)


class SubmittedJob(JobResource):
    """A job that was just asked for."""

    cached: bool = Field(
        description="Whether it is one that another request had submitted: both ask for the same."
    )


class JobPage(BaseModel):
    """One page of a list of jobs."""

    jobs: list[JobResource]
    next_page_token: str | None = Field(
        description="Give it as page_token for the jobs after these; null: there are no more."
    )

    @classmethod
    def of(cls, page: Page) -> Self:
        """Show the catalogue's page."""
        return cls(jobs=[JobResource.of(job) for job in page.jobs], next_page_token=page.next)


def address(job_id: str) -> str:
    """Return the path of a job."""
    return f"/v1/jobs/{job_id}"


def _links(job: Job) -> dict[str, str]:
    base = address(job.id)
    links = {"self": base, "cancel": f"{base}/cancel", "events": f"{base}/events"}
    if job.batch is not None:
        links["batch"] = f"/v1/batches/{job.batch}"
    lacking = {"certificate"} if job.spec.get("certificate") is False else set()
    if job.kind in KINDS:  # else of another version of this program
        links |= {n: f"{base}/{n}" for n in KINDS[job.kind].results if n not in lacking}
    return links
