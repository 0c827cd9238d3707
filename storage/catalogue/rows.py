"""From rows to records, and the small statements every part of the catalogue needs."""

from collections.abc import Mapping
from dataclasses import asdict
from typing import Any

from sqlalchemy import Connection, Row, func, insert, select, update

from jointplay.records.job import JobError
from jointplay.storage.catalogue import tables
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


def find_job(connection: Connection, job: str) -> Job:
    """Return a job; JobNotFound if there is none."""
    row = connection.execute(select(job_table).where(job_table.c.id == job)).one_or_none()
    if row is None:
        raise JobNotFound(job)
    return job_record(row._mapping)


def lock_job(connection: Connection, job: str) -> Job:
    """Return a job and keep others from changing it until the unit ends (SQLite: they wait)."""
    statement = select(job_table).where(job_table.c.id == job).with_for_update()
    row = connection.execute(statement).one_or_none()
    if row is None:
        raise JobNotFound(job)
    return job_record(row._mapping)


def step_job(
    connection: Connection,
    job: str,
    to: JobState,
    now: float,
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
        values["finished"] = now
    moved = connection.execute(
        update(job_table)
        .where(job_table.c.id == job, job_table.c.state.in_(allowed))
        .values(values)
    )
    if moved.rowcount == 0:
        return False
    record_event(connection, job, now, to.value, {"error": asdict(error)} if error else {})
    return True


def record_event(
    connection: Connection, job: str, now: float, kind: str, data: Mapping[str, Any]
) -> None:
    """Append an event; the job must be locked or just changed in this unit."""
    table = tables.event
    last = select(func.coalesce(func.max(table.c.seq), 0)).where(table.c.job == job)
    seq = connection.execute(last).scalar_one() + 1
    connection.execute(insert(table).values(job=job, seq=seq, time=now, type=kind, data=dict(data)))
