"""Small statements that every part of the catalogue needs: find a job, move it, note an event."""

from collections.abc import Mapping
from dataclasses import asdict
from typing import Any

from sqlalchemy import func, insert, select, update

from jointplay.records.job import JobError
from jointplay.storage.catalogue import tables
from jointplay.storage.catalogue.connections import Unit
from jointplay.storage.catalogue.errors import JobNotFound
from jointplay.storage.catalogue.records import LEGAL_STEPS, Job, JobState

job_table = tables.job


def find_job(unit: Unit, job: str, *, locked: bool = False) -> Job:
    """Return a job; JobNotFound if there is none."""
    found = select(job_table).where(job_table.c.id == job)
    row = unit.execute(found.with_for_update(key_share=True) if locked else found).one_or_none()
    if row is None:
        raise JobNotFound(job)
    return Job(**row._mapping)


def lock_job(unit: Unit, job: str) -> Job:
    """Return a job and keep others from changing it until the unit ends (SQLite: they wait).

    Comes before every change of its blocks: two units that lock both in one order never wait for
    each other.
    """
    return find_job(unit, job, locked=True)


def step_job(unit: Unit, job: str, to: JobState, *, error: JobError | None = None) -> None:
    """Move a job to a state and record the event, if its present state allows the step."""
    allowed = [state for state, steps in LEGAL_STEPS.items() if to in steps]
    values: dict[str, Any] = {"state": to}
    if error is not None:
        values["error"] = error
    if to.terminal:
        values["finished"] = unit.now
    may_step = (job_table.c.id == job, job_table.c.state.in_(allowed))
    if unit.execute(update(job_table).where(*may_step).values(values)).rowcount:
        record_event(unit, job, to.value, {"error": asdict(error)} if error else {})


def record_event(unit: Unit, job: str, kind: str, data: Mapping[str, Any]) -> None:
    """Append an event; the job must be locked or just changed in this unit."""
    table = tables.event
    last = select(func.coalesce(func.max(table.c.seq), 0)).where(table.c.job == job)
    seq = unit.execute(last).scalar_one() + 1
    unit.execute(insert(table).values(job=job, seq=seq, time=unit.now, type=kind, data=dict(data)))
