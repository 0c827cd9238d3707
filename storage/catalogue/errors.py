"""Errors of requests to the catalogue, independent of HTTP."""

from typing import Final

BUSY: Final = "is held by another program"
SILENT: Final = "does not answer"


class CatalogueError(Exception):
    """Base of the catalogue's own errors."""


class Unavailable(CatalogueError):
    """The database cannot be read or written at the moment; nothing was changed.

    `full` says that its disk is.
    """

    def __init__(self, reason: str, *, full: bool = False) -> None:
        super().__init__(f"the catalogue {reason}")
        self.full = full


class Interrupted(Unavailable):
    """A unit was broken off, and may be begun anew at once: nothing it did is left."""


class Broken(Unavailable):
    """Pages of the database are damaged, or tables are gone; a backup may be put back."""

    def __init__(self) -> None:
        super().__init__("is damaged, or is being restored")


class WrongRevision(CatalogueError, RuntimeError):
    """The database's schema is not one of this program."""


class JobNotFound(CatalogueError):
    """No job has this id."""

    def __init__(self, job: str) -> None:
        super().__init__(f"there is no job {job!r}")


class JobNotFinished(CatalogueError):
    """A job that is not finished cannot be deleted."""

    def __init__(self, job: str, state: str) -> None:
        super().__init__(f"job {job} is {state}; cancel it before it is deleted")


class BatchNotFound(CatalogueError):
    """No batch has this id."""

    def __init__(self, batch: str) -> None:
        super().__init__(f"there is no batch {batch!r}")


class BatchNotFinished(CatalogueError):
    """A batch with jobs that are not finished cannot be deleted."""

    def __init__(self, batch: str, live: int) -> None:
        jobs = "job has" if live == 1 else "jobs have"
        super().__init__(
            f"{live} {jobs} not ended of batch {batch}; cancel it before it is deleted"
        )


class KeyNotFound(CatalogueError):
    """No key of the service has this id."""

    def __init__(self, key: str) -> None:
        super().__init__(f"there is no key {key!r}")


class KeyReused(CatalogueError):
    """An idempotency key came back with a different request."""

    def __init__(self, key: str) -> None:
        used = f"the idempotency key {key!r} was used for a different request"
        super().__init__(f"{used}; use a new key")


class QuotaExceeded(CatalogueError):
    """An owner would have more than one may have of what the sentence names."""


class RetriedMeanwhile(CatalogueError):
    """A retry of a job was queued by another request after it was looked at."""

    def __init__(self, job: str) -> None:
        super().__init__(f"a retry of job {job} was queued meanwhile; ask again")


class TooManyWorkers(CatalogueError):
    """A key has as many workers already as one may have."""

    def __init__(self, most: int) -> None:
        super().__init__(f"{most} workers of this key were heard of in the last minute")


class Fenced(CatalogueError):
    """The block is no longer this attempt's: stop, write nothing, report nothing."""

    def __init__(self, block: str, attempt: int) -> None:
        super().__init__(f"attempt {attempt} does not hold block {block} (any more)")
