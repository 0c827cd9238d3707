"""Batches: many jobs accepted or refused as one, looked at and cancelled as one."""

from collections.abc import Sequence
from dataclasses import replace

from sqlalchemy import Connection, and_, func, insert, select, update

from jointplay.storage.catalogue import tables
from jointplay.storage.catalogue.errors import BatchNotFound
from jointplay.storage.catalogue.records import (
    Batch,
    JobState,
    NewJob,
    SubmissionKey,
    SubmittedBatch,
)
from jointplay.storage.catalogue.submission import (
    drop_blocks,
    earlier_answer,
    insert_jobs,
    remember_key,
    request_cancel,
)

LARGEST_BATCH = 10_000
_job = tables.job


def submit_batch(
    connection: Connection,
    batch_id: str,
    job_ids: Sequence[str],
    jobs: Sequence[NewJob],
    owner: str,
    label: str | None,
    key: SubmissionKey | None,
    now: float,
) -> SubmittedBatch:
    """Store a batch and all its jobs, or find the one an earlier request made."""
    if key is not None:
        earlier = earlier_answer(connection, key, now)
        if earlier is not None and earlier.batch is not None:
            found = select(_job.c.id).where(_job.c.batch == earlier.batch).order_by(_job.c.id)
            known = tuple(connection.execute(found).scalars())
            return SubmittedBatch(find_batch(connection, earlier.batch), known, created=False)
    connection.execute(
        insert(tables.batch).values(
            id=batch_id, owner=owner, label=label, created=now, count=len(jobs)
        )
    )
    members = [replace(job, batch=batch_id, owner=owner) for job in jobs]
    insert_jobs(connection, list(zip(job_ids, members, strict=True)), now)
    if key is not None:
        remember_key(connection, key, now, batch=batch_id)
    return SubmittedBatch(find_batch(connection, batch_id), tuple(job_ids), created=True)


def find_batch(connection: Connection, batch_id: str) -> Batch:
    """Return a batch with the progress of the whole; BatchNotFound if there is none."""
    row = connection.execute(
        select(tables.batch).where(tables.batch.c.id == batch_id)
    ).one_or_none()
    if row is None:
        raise BatchNotFound(batch_id)
    fields = dict(row._mapping)
    states = dict.fromkeys(JobState, 0)
    going = 0.0  # jobs, as far as those still live lack
    counted = connection.execute(
        select(_job.c.state, func.count(), func.sum(1.0 - _job.c.progress_fraction))
        .where(_job.c.batch == batch_id)
        .group_by(_job.c.state)
    )
    for name, count, lacking in counted:
        state = JobState(name)
        states[state] = count
        if not state.terminal:
            going += lacking
    return Batch(**fields, states=states, fraction=max(1.0 - going / fields["count"], 0.0))


def cancel_batch(connection: Connection, batch_id: str, now: float) -> Batch:
    """Cancel every job of a batch that has not ended, as `request_cancel` does for one."""
    find_batch(connection, batch_id)
    queued = and_(_job.c.batch == batch_id, _job.c.state == JobState.queued.value)
    waiting = select(_job.c.id).where(queued)
    drop_blocks(connection, tables.block.c.job.in_(waiting), untouched=False)
    event = tables.event
    last = (
        select(event.c.job, func.max(event.c.seq).label("seq"))
        .where(event.c.job.in_(waiting))
        .group_by(event.c.job)
    )
    events = [
        {
            "job": row.job,
            "seq": row.seq + 1,
            "time": now,
            "type": JobState.cancelled.value,
            "data": {},
        }
        for row in connection.execute(last)
    ]
    if events:
        connection.execute(insert(event), events)
    connection.execute(
        update(_job).where(queued).values(state=JobState.cancelled.value, finished=now)
    )
    started = select(_job.c.id).where(
        _job.c.batch == batch_id, _job.c.state == JobState.running.value
    )
    for job_id in connection.execute(started).scalars().all():
        request_cancel(connection, job_id, now)
    return find_batch(connection, batch_id)
