"""A job as the service describes it."""

from dataclasses import asdict, dataclass, field
from datetime import datetime
from typing import Any, Self

TERMINAL_STATES = frozenset({"succeeded", "failed", "cancelled"})


@dataclass(frozen=True)
class Progress:
    """How far a job is: simulated ``time`` in s, and ``fraction`` of the whole from 0 to 1.

    ``steps`` of the solver are known once it has told.
    """

    time: float
    fraction: float
    steps: int | None = None


@dataclass(frozen=True)
class JobError:
    """Why a job failed.

    ``kind`` is "user", "solver", "platform" or "limit" (``error.class`` of the service).
    """

    kind: str
    detail: str


@dataclass(frozen=True)
class Job:
    """One job; ``job`` is its document with every default filled in.

    ``activity`` says what it is busy with before it advances, such as compiling.  ``cached``: the
    answer to a submission was a job that was there already.
    """

    id: str
    kind: str
    label: str | None
    batch: str | None
    state: str
    activity: str | None
    progress: Progress
    attempt: int
    created: datetime
    started: datetime | None
    finished: datetime | None
    expires: datetime | None
    error: JobError | None
    links: dict[str, str]
    job: dict[str, Any]
    solver_version: str | None
    cached: bool = field(default=False, compare=False)

    @property
    def is_finished(self) -> bool:
        """Whether the state will not change any more."""
        return self.state in TERMINAL_STATES

    def to_document(self) -> dict[str, Any]:
        """Return the job as JSON takes it."""
        return {
            name: value.isoformat() if isinstance(value, datetime) else value
            for name, value in asdict(self).items()
        }

    @classmethod
    def from_document(cls, document: dict[str, Any]) -> Self:
        """Read the service's JSON."""
        error = document["error"]
        return cls(
            id=document["id"],
            kind=document["kind"],
            label=document["label"],
            batch=document["batch"],
            state=document["state"],
            activity=document["activity"],
            progress=Progress(**document["progress"]),
            attempt=document["attempt"],
            created=datetime.fromisoformat(document["created"]),
            started=_moment(document["started"]),
            finished=_moment(document["finished"]),
            expires=_moment(document["expires"]),
            error=None if error is None else JobError(error["class"], error["detail"]),
            links=document["links"],
            job=document["job"],
            solver_version=document["solver_version"],
            cached=document.get("cached", False),
        )


def _moment(text: str | None) -> datetime | None:
    return None if text is None else datetime.fromisoformat(text)
