"""Events as the stream carries them."""

from typing import Any, Self

from pydantic import BaseModel, Field

from jointplay.service.jobs.schemas import Progress, moment
from jointplay.storage.catalogue import Event, JobState, JobStatus


class JobEvent(BaseModel):
    """One thing that happened to a job; its number is the id of the event in the stream."""

    seq: int = Field(description="Counts from 1 without gaps.")
    type: str = Field(description="A state of the job, or claimed, compiling, released, lost.")
    time: str = Field(description="When it happened, RFC 3339 in UTC.")
    data: dict[str, Any] = Field(description="What belongs to it: block, attempt, error.")

    @classmethod
    def of(cls, event: Event) -> Self:
        """Show the catalogue's record."""
        time = moment(event.time).isoformat()
        return cls(seq=event.seq, type=event.type, time=time, data=event.data)


class JobProgress(BaseModel):
    """Progress of a job now; these events have no number, and only the newest matters."""

    state: JobState
    activity: str | None
    attempt: int
    progress: Progress

    @classmethod
    def of(cls, status: JobStatus) -> Self:
        """Show the catalogue's record."""
        return cls(
            state=status.state,
            activity=status.activity,
            attempt=status.attempt,
            progress=Progress(time=status.time, fraction=status.fraction, steps=status.steps),
        )
