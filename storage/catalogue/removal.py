"""The end of a job's life: it expires, its results are removed, and a row says that it was."""

from collections.abc import Sequence

from sqlalchemy import Connection, select, update

from jointplay.storage.catalogue import tables
from jointplay.storage.catalogue.errors import JobNotFinished
from jointplay.storage.catalogue.records import Job, JobState
from jointplay.storage.catalogue.rows import find_job, lock_job

_job = tables.job
_TERMINAL = [state.value for state in JobState if state.terminal]


def expire(connection: Connection, job_id: str, now: float) -> Job:
    """Let a finished job expire now, unless it did before.

    Raises
    ------
    JobNotFinished
        It is queued, running or cancelling.
    """
    job = lock_job(connection, job_id)
    if not job.state.terminal:
        raise JobNotFinished(job_id, job.state.value)
    if not job.expired(now):
        connection.execute(update(_job).where(_job.c.id == job_id).values(expires=now))
    return find_job(connection, job_id)


def removable(connection: Connection, limit: int, now: float) -> tuple[str, ...]:
    """Return expired jobs whose results are still there, those first that expired first."""
    found = connection.execute(
        select(_job.c.id)
        .where(_job.c.removed.is_(None), _job.c.expires <= now, _job.c.state.in_(_TERMINAL))
        .order_by(_job.c.expires)
        .limit(limit)
    )
    return tuple(found.scalars())


def mark_removed(connection: Connection, jobs: Sequence[str], now: float) -> None:
    """Remember that the results of jobs are gone."""
    connection.execute(update(_job).where(_job.c.id.in_(jobs)).values(removed=now))
