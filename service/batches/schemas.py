"""Batches as they are sent and shown."""

from datetime import UTC, datetime
from typing import Any, Self

from pydantic import BaseModel, ConfigDict, Field

from jointplay.storage.catalogue import Batch, JobState

MOST_JOBS = 10_000
LONGEST_LABEL = 200


class BatchDocument(BaseModel):
    """Jobs of any kinds that are accepted or refused together."""

    model_config = ConfigDict(extra="forbid")

    jobs: list[Any] = Field(
        min_length=1,
        max_length=MOST_JOBS,
        description="The jobs, in the order in which they are queued.",
    )
    label: str = Field(
        default="", max_length=LONGEST_LABEL, description="A name of your own for the batch."
    )


class BatchProgress(BaseModel):
    """Progress of the whole batch."""

    fraction: float = Field(ge=0, le=1, description="0 to 1, every job weighing the same.")


class BatchResource(BaseModel):
    """Jobs that were submitted together."""

    id: str
    label: str | None
    created: datetime
    jobs: int = Field(description="Number of jobs.")
    states: dict[JobState, int] = Field(description="How many jobs are in each state.")
    progress: BatchProgress
    finished: bool = Field(description="Whether all jobs have ended, however they did.")
    links: dict[str, str] = Field(description="Addresses of the batch and of its jobs.")

    @classmethod
    def of(cls, batch: Batch, **more: Any) -> Self:
        """Show the catalogue's record."""
        base = address(batch.id)
        return cls(
            id=batch.id,
            label=batch.label,
            created=datetime.fromtimestamp(batch.created, UTC),
            jobs=batch.count,
            states=dict(batch.states),
            progress=BatchProgress(fraction=batch.fraction),
            finished=batch.finished,
            links={"self": base, "jobs": f"{base}/jobs", "cancel": f"{base}/cancel"},
            **more,
        )


class AcceptedBatch(BatchResource):
    """A batch that was just queued."""

    job_ids: list[str] = Field(description="Ids of its jobs, in the order of the request.")


def address(batch_id: str) -> str:
    """Return the path of a batch."""
    return f"/v1/batches/{batch_id}"
