"""The catalogue of jobs: submission, claims, leases, fencing, outbox, history."""

from storage.catalogue.catalogue import Catalogue
from storage.catalogue.errors import CatalogueError, Fenced, JobNotFound, KeyReused
from storage.catalogue.records import (
    Attempt,
    Block,
    BlockState,
    Claim,
    ErrorClass,
    Event,
    Job,
    JobError,
    JobPage,
    JobState,
    NewJob,
    Reaped,
    SubmissionKey,
    Submitted,
    Verdict,
    WakeUp,
)

__all__ = [
    "Attempt",
    "Block",
    "BlockState",
    "Catalogue",
    "CatalogueError",
    "Claim",
    "ErrorClass",
    "Event",
    "Fenced",
    "Job",
    "JobError",
    "JobNotFound",
    "JobPage",
    "JobState",
    "KeyReused",
    "NewJob",
    "Reaped",
    "SubmissionKey",
    "Submitted",
    "Verdict",
    "WakeUp",
]
