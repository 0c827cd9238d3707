"""From rows to records, and the small statements every part of the catalogue needs."""

from collections.abc import Mapping
from dataclasses import asdict
from typing import Any

from sqlalchemy import Row, func, insert, select, update

from jointplay.records.job import JobError
from jointplay.storage.catalogue import tables
from jointplay.storage.catalogue.connections import Unit
from jointplay.storage.catalogue.errors import JobNotFound
from jointplay.storage.catalogue.records import (
    LEGAL_STEPS,
    Attempt,
    Block,
    BlockState,
    Event,
    Job,
    JobState,
)

job_table, block_table = tables.job, tables.block


def job_record(row: Mapping[Any, Any]) -> Job:
    """Return the job in a row of the table job."""
    fields = dict(row)
    error = fields.pop("error")
    state = JobState(fields.pop("state"))
    return Job(**fields, state=state, error=JobError(**error) if error else None)


def block_record(row: Row[Any]) -> Block:
    """Return the block in a row of the table block."""
    fields = dict(row._mapping)
    return Block(**fields | {"state": BlockState(fields["state"])})


def attempt_record(row: Row[Any]) -> Attempt:
    """Return the attempt in a row of the table attempt."""
    return Attempt(**row._mapping)


def event_record(row: Row[Any]) -> Event:
    """Return the event in a row of the table event."""
    return Event(**row._mapping)


def find_job(unit: Unit, job: str) -> Job:
    """Return a job; JobNotFound if there is none."""
    row = unit.execute(select(job_table).where(job_table.c.id == job)).one_or_none()
    if row is None:
        raise JobNotFound(job)
    return job_record(row._mapping)


def lock_job(unit: Unit, job: str) -> Job:
    """Return a job and keep others from changing it until the unit ends (SQLite: they wait)."""
    statement = select(job_table).where(job_table.c.id == job).with_for_update()
    row = unit.execute(statement).one_or_none()
    if row is None:
        raise JobNotFound(job)
    return job_record(row._mapping)


def step_job(
    unit: Unit,
    job: str,
    to: JobState,
    *,
    error: JobError | None = None,
    **changes: Any,
) -> bool:
    """Move a job to a state and record the event, if its present state allows the step.

    Returns
    -------
    bool
        Whether the job moved.
    """
    allowed = [state.value for state, steps in LEGAL_STEPS.items() if to in steps]
    values: dict[str, Any] = {"state": to.value} | changes
    if error is not None:
        values["error"] = asdict(error)
    if to.terminal:
        values["finished"] = unit.now
    moved = unit.execute(
        update(job_table)
        .where(job_table.c.id == job, job_table.c.state.in_(allowed))
        .values(values)
    )
    if moved.rowcount == 0:
        return False
    record_event(unit, job, to.value, {"error": asdict(error)} if error else {})
    return True


def record_event(unit: Unit, job: str, kind: str, data: Mapping[str, Any]) -> None:
    """Append an event; the job must be locked or just changed in this unit."""
    table = tables.event
    last = select(func.coalesce(func.max(table.c.seq), 0)).where(table.c.job == job)
    seq = unit.execute(last).scalar_one() + 1
    unit.execute(insert(table).values(job=job, seq=seq, time=unit.now, type=kind, data=dict(data)))
