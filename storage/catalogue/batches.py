"""Batches: many jobs accepted or refused as one, looked at and cancelled as one."""

from collections.abc import Collection, Sequence
from itertools import islice
from typing import Any

from sqlalchemy import delete, func, insert, literal, select, update

from jointplay.storage.catalogue import tables
from jointplay.storage.catalogue.connections import Unit
from jointplay.storage.catalogue.databases.postgresql import lock_numbers
from jointplay.storage.catalogue.errors import BatchNotFinished, BatchNotFound
from jointplay.storage.catalogue.idempotency import (
    earlier_answer,
    forget_batch,
    remember_batch,
    remembered,
)
from jointplay.storage.catalogue.quotas import Quota, Uses
from jointplay.storage.catalogue.records import (
    TERMINAL,
    Batch,
    JobState,
    NewJob,
    SubmissionKey,
    SubmittedBatch,
)
from jointplay.storage.catalogue.retries import require_unretried
from jointplay.storage.catalogue.submission import (
    drop_blocks,
    insert_jobs,
    request_cancel,
    row_of,
)

LARGEST_BATCH = 10_000
_AT_A_TIME = 500
"""Jobs whose rows are in memory; their statements cost a hundredth of their rows."""
_job = tables.job


def submit_batch(
    unit: Unit,
    batch_id: str,
    job_ids: Sequence[str],
    jobs: Collection[NewJob],
    label: str | None,
    key: SubmissionKey | None,
    owner: str,
    quota: Quota,
) -> SubmittedBatch:
    """Store a batch and all its jobs, or find the one an earlier request made."""
    if key is not None:
        lock_numbers(unit.connection, key.number)
        earlier = earlier_answer(unit, key)
        if earlier is not None and earlier.batch is not None:
            return _submitted(unit, earlier.batch)
    Uses(unit, [owner] if quota else []).add(owner, len(jobs), quota)
    new_batch = {"id": batch_id, "label": label, "created": unit.now, "count": len(jobs)}
    unit.execute(insert(tables.batch).values(new_batch | {"owner": owner}))
    members = zip(job_ids, jobs, strict=True)
    while some := [
        (row_of(name, new, unit.now, batch_id), new) for name, new in islice(members, _AT_A_TIME)
    ]:
        require_unretried(unit, [new.retry_of for _, new in some if new.retry_of])
        insert_jobs(unit, some)
    if key is not None:
        remember_batch(unit, key, batch_id)
    return SubmittedBatch(find_batch(unit, batch_id), tuple(job_ids), created=True)


def _submitted(unit: Unit, batch_id: str) -> SubmittedBatch:
    """Return the answer to a request that had been answered with a batch."""
    found = select(_job.c.id).where(_job.c.batch == batch_id).order_by(_job.c.id)
    known = tuple(unit.execute(found).scalars())
    return SubmittedBatch(find_batch(unit, batch_id), known, created=False)


def submitted_by(unit: Unit, key: SubmissionKey) -> SubmittedBatch | None:
    """Return the batch that an earlier request with a key made, if it is remembered.

    Raises
    ------
    KeyReused
        The key was used for another request.
    """
    row = remembered(unit, key)
    return None if row is None or row.batch is None else _submitted(unit, row.batch)


def find_batch(unit: Unit, batch_id: str) -> Batch:
    """Return a batch with the progress of the whole; BatchNotFound if there is none."""
    rows = unit.execute(select(tables.batch).where(tables.batch.c.id == batch_id)).all()
    if not rows:
        raise BatchNotFound(batch_id)
    (found,) = _with_progress(unit, rows)
    return found


def page_of_batches(
    unit: Unit, *, limit: int = 50, after: str | None = None, owner: str | None = None
) -> tuple[tuple[Batch, ...], str | None]:
    """Return a page of batches, newest first, and the id to give as `after` for the next one."""
    columns = tables.batch.c
    statement = select(tables.batch).order_by(columns.id.desc()).limit(limit + 1)
    if after is not None:
        statement = statement.where(columns.id < after)
    if owner is not None:
        statement = statement.where(columns.owner == owner)
    rows = unit.execute(statement).all()
    found = _with_progress(unit, rows[:limit])
    return tuple(found), found[-1].id if len(rows) > limit else None


def _with_progress(unit: Unit, rows: Sequence[Any]) -> list[Batch]:
    """Return batches by their rows, with the progress of their jobs."""
    states = {row.id: dict.fromkeys(JobState, 0) for row in rows}
    going = dict.fromkeys(states, 0.0)  # jobs, as far as those still live lack
    counted = unit.execute(
        select(_job.c.batch, _job.c.state, func.count(), func.sum(1.0 - _job.c.progress_fraction))
        .where(_job.c.batch.in_(list(states)))
        .group_by(_job.c.batch, _job.c.state)
    )
    for batch, state, count, lacking in counted:
        states[batch][state] = count
        if not state.terminal:
            going[batch] += lacking
    return [
        Batch(
            **row._mapping,
            states=states[row.id],
            fraction=max(1.0 - going[row.id] / row._mapping["count"], 0.0),
        )
        for row in rows
    ]


def delete_batch(unit: Unit, batch_id: str) -> Batch:
    """Delete a batch, with its jobs as `upkeep.expire` does. Returns it as it was.

    A request that is sent again with its key makes a batch anew.

    Raises
    ------
    BatchNotFound
    BatchNotFinished
        Some of its jobs have not ended; nothing was deleted.
    """
    batch = find_batch(unit, batch_id)
    if not batch.finished:
        live = sum(count for state, count in batch.states.items() if not state.terminal)
        raise BatchNotFinished(batch_id, live)
    there = tables.unexpired(unit.now)
    gone = {"expires": unit.now, "deleted": unit.now}
    unit.execute(update(_job).where(_job.c.batch == batch_id, there).values(gone))
    forget_batch(unit, batch_id)
    unit.execute(delete(tables.batch).where(tables.batch.c.id == batch_id))
    return batch


def cancel_batch(unit: Unit, batch_id: str) -> Batch:
    """Cancel every job that has not ended, as `request_cancel` does; or BatchNotFound."""
    find_batch(unit, batch_id)
    queued = (_job.c.batch == batch_id) & (_job.c.state == JobState.queued)
    if unit.shared:  # in the order that all others have
        live = (_job.c.batch == batch_id) & _job.c.state.not_in(TERMINAL)
        unit.execute(
            select(_job.c.id).where(live).order_by(_job.c.id).with_for_update(key_share=True)
        ).all()
    waiting = select(_job.c.id).where(queued)
    drop_blocks(unit, tables.block.c.job.in_(waiting), untouched=False)
    event = tables.event
    new = {
        event.c.job: event.c.job,
        event.c.seq: func.max(event.c.seq) + 1,
        event.c.time: literal(unit.now, event.c.time.type),
        event.c.type: literal(JobState.cancelled.value, event.c.type.type),
        event.c.data: literal({}, event.c.data.type),
    }
    one_each = select(*new.values()).where(event.c.job.in_(waiting)).group_by(event.c.job)
    unit.execute(insert(event).from_select(list(new), one_each))
    unit.execute(update(_job).where(queued).values(state=JobState.cancelled, finished=unit.now))
    started = select(_job.c.id).where(_job.c.batch == batch_id, _job.c.state == JobState.running)
    for job_id in unit.execute(started).scalars().all():
        request_cancel(unit, job_id)
    return find_batch(unit, batch_id)
