"""The end of a job's life: it expires, its results are removed, and a row says that it was."""

from collections.abc import Sequence

from sqlalchemy import select, update

from jointplay.storage.catalogue import tables
from jointplay.storage.catalogue.connections import Unit
from jointplay.storage.catalogue.errors import JobNotFinished
from jointplay.storage.catalogue.records import Job, JobState
from jointplay.storage.catalogue.rows import find_job, lock_job

_job = tables.job
_TERMINAL = [state.value for state in JobState if state.terminal]


def expire(unit: Unit, job_id: str) -> Job:
    """Let a finished job expire now, unless it did before; its results are removed soon.

    Raises
    ------
    JobNotFound
    JobNotFinished
        It is queued, running or cancelling: it has to be cancelled first.
    """
    job = lock_job(unit, job_id)
    if not job.state.terminal:
        raise JobNotFinished(job_id, job.state.value)
    if not job.expired(unit.now):
        unit.execute(update(_job).where(_job.c.id == job_id).values(expires=unit.now))
    return find_job(unit, job_id)


def removable(unit: Unit, limit: int) -> tuple[str, ...]:
    """Return expired jobs whose results are still there, those first that expired first."""
    found = unit.execute(
        select(_job.c.id)
        .where(_job.c.removed.is_(None), _job.c.expires <= unit.now, _job.c.state.in_(_TERMINAL))
        .order_by(_job.c.expires)
        .limit(limit)
    )
    return tuple(found.scalars())


def mark_removed(unit: Unit, jobs: Sequence[str]) -> None:
    """Remember that the results of jobs are gone."""
    unit.execute(update(_job).where(_job.c.id.in_(jobs)).values(removed=unit.now))
