"""The catalogue of jobs: submission, claims, leases, fencing, outbox, history."""

from typing import TYPE_CHECKING, Any

from jointplay.storage.catalogue.errors import (
    BatchNotFound,
    CatalogueError,
    Fenced,
    JobNotFinished,
    JobNotFound,
    KeyReused,
    Unavailable,
)
from jointplay.storage.catalogue.records import (
    Attempt,
    Batch,
    Block,
    BlockState,
    Claim,
    Event,
    Job,
    JobFilter,
    JobPage,
    JobState,
    JobStatus,
    NewJob,
    Reaped,
    SubmissionKey,
    Submitted,
    SubmittedBatch,
    Verdict,
    WakeUp,
)

if TYPE_CHECKING:
    from jointplay.storage.catalogue.catalogue import Catalogue

__all__ = [
    "Attempt",
    "Batch",
    "BatchNotFound",
    "Block",
    "BlockState",
    "Catalogue",
    "CatalogueError",
    "Claim",
    "Event",
    "Fenced",
    "Job",
    "JobFilter",
    "JobNotFinished",
    "JobNotFound",
    "JobPage",
    "JobState",
    "JobStatus",
    "KeyReused",
    "NewJob",
    "Reaped",
    "SubmissionKey",
    "Submitted",
    "SubmittedBatch",
    "Unavailable",
    "Verdict",
    "WakeUp",
]


def __getattr__(name: str) -> Any:
    """Import the catalogue itself on first use: a local run needs its records, not its database."""
    if name != "Catalogue":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from jointplay.storage.catalogue.catalogue import Catalogue

    return Catalogue
