"""Jobs that failed or were cancelled and are to be computed again, as new jobs.

What has ended never changes: the new job's first event names the one that it repeats, and the last
event of that one names the new job.
"""

from collections.abc import Sequence
from typing import Final, NamedTuple

from sqlalchemy import exists, select

from jointplay.storage.catalogue import tables
from jointplay.storage.catalogue.connections import Unit
from jointplay.storage.catalogue.errors import RetriedMeanwhile
from jointplay.storage.catalogue.records import Job, JobState
from jointplay.storage.catalogue.rows import record_event

RETRIABLE: Final = (JobState.failed, JobState.cancelled)
"""States in which a job can be retried."""
_RETRIED: Final = "retried"
_job, _event = tables.job, tables.event


class Unsuccessful(NamedTuple):
    """A job that failed or was cancelled, and whether a retry of it was ever queued."""

    job: Job
    retried: bool


def unsuccessful(unit: Unit, batch_id: str) -> tuple[Unsuccessful, ...]:
    """Return the jobs of a batch that failed or were cancelled and did not expire, in order."""
    noted = exists().where(_event.c.job == _job.c.id, _event.c.type == _RETRIED)
    there = tables.unexpired(unit.now)
    rows = unit.execute(
        select(_job, noted.label(_RETRIED))
        .where(_job.c.batch == batch_id, _job.c.state.in_(RETRIABLE), there)
        .order_by(_job.c.id)
    )
    found = [dict(row._mapping) for row in rows]
    return tuple(Unsuccessful(retried=bool(row.pop(_RETRIED)), job=Job(**row)) for row in found)


def require_unretried(unit: Unit, jobs: Sequence[str]) -> None:
    """Have others wait who retry some jobs; RetriedMeanwhile if one of these was retried."""
    if not jobs:
        return
    _lock(unit, jobs)
    noted = select(_event.c.job).where(_event.c.job.in_(jobs), _event.c.type == _RETRIED).limit(1)
    for job in unit.execute(noted).scalars():
        raise RetriedMeanwhile(job)


def _lock(unit: Unit, jobs: Sequence[str]) -> None:
    if unit.shared:  # in the order that all others have
        locked = select(_job.c.id).where(_job.c.id.in_(jobs)).order_by(_job.c.id)
        unit.execute(locked.with_for_update(key_share=True)).all()


def record(unit: Unit, retries: Sequence[tuple[str, str]]) -> None:
    """Record with jobs, the first of each pair, which new jobs repeat them."""
    if not retries:
        return
    _lock(unit, [old for old, _ in retries])
    for repeated, new in retries:
        record_event(unit, repeated, _RETRIED, {"job": new})


def record_once(unit: Unit, old: str, new: str) -> None:
    """Record with a job that another one, which was there, computes the same, but only once."""
    noted = select(_event.c.data).where(_event.c.job == old, _event.c.type == _RETRIED)
    if {"job": new} not in unit.execute(noted).scalars().all():
        record(unit, [(old, new)])
