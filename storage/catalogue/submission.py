"""Accepting jobs and cancelling them: what users ask for."""

from sqlalchemy import Connection, and_, delete, exists, func, insert, select, update

from storage.catalogue import tables
from storage.catalogue.errors import KeyReused
from storage.catalogue.records import (
    BlockState,
    Job,
    JobState,
    NewJob,
    SubmissionKey,
    Submitted,
)
from storage.catalogue.rows import find_job, lock_job, record_event, step_job

FRESH_QUEUE = "jobs"
_LIVE = (BlockState.queued.value, BlockState.running.value)


def submit(
    connection: Connection, job_id: str, new: NewJob, key: SubmissionKey | None, now: float
) -> Submitted:
    """Store a job, its blocks and their wake-ups, or find the job an earlier request made."""
    if key is not None:
        earlier = _earlier_job(connection, key, now)
        if earlier is not None:
            return Submitted(earlier, created=False)
    connection.execute(
        insert(tables.job).values(
            id=job_id,
            kind=new.kind,
            owner=new.owner,
            label=new.label,
            batch=new.batch,
            spec=new.spec,
            digest=new.digest,
            solver_version=new.solver_version,
            result_schema=new.result_schema,
            state=JobState.queued.value,
            progress_time=0.0,
            progress_fraction=0.0,
            attempt=0,
            created=now,
            expires=new.expires,
        )
    )
    names = [f"{job_id}-{index}" for index in range(len(new.blocks))]
    connection.execute(
        insert(tables.block),
        [
            {
                "id": name,
                "job": job_id,
                "index": index,
                "first": first,
                "count": count,
                "state": BlockState.queued.value,
                "attempt": 0,
                "losses": 0,
                "watermark": 0,
                "progress_time": 0.0,
                "progress_fraction": 0.0,
            }
            for index, (name, (first, count)) in enumerate(zip(names, new.blocks, strict=True))
        ],
    )
    connection.execute(
        insert(tables.outbox),
        [
            {"block": name, "queue": FRESH_QUEUE, "created": now, "due": now, "tries": 0}
            for name in names
        ],
    )
    record_event(connection, job_id, now, JobState.queued.value, {})
    if key is not None:
        connection.execute(
            insert(tables.idempotency).values(
                owner=key.owner,
                key=key.key,
                fingerprint=key.fingerprint,
                job=job_id,
                created=now,
                expires=now + key.seconds,
            )
        )
    return Submitted(find_job(connection, job_id), created=True)


def _earlier_job(connection: Connection, key: SubmissionKey, now: float) -> Job | None:
    table = tables.idempotency
    same_key = and_(table.c.owner == key.owner, table.c.key == key.key)
    row = connection.execute(select(table).where(same_key)).one_or_none()
    if row is None:
        return None
    if row.expires <= now or row.job is None:
        connection.execute(delete(table).where(same_key))
        return None
    if row.fingerprint != key.fingerprint:
        raise KeyReused(key.key)
    return find_job(connection, row.job)


def request_cancel(connection: Connection, job_id: str, now: float) -> Job:
    """Cancel what has not started at once, and ask workers to stop what they hold.

    A block that a lost worker left behind has results; it stays queued, so that a worker closes
    its store properly.
    """
    job = lock_job(connection, job_id)
    if job.state.terminal or job.state is JobState.cancelling:
        return job
    block = tables.block
    drop_queued_blocks(connection, job_id, untouched=True)
    live = connection.execute(
        select(func.count()).where(block.c.job == job_id, block.c.state.in_(_LIVE))
    ).scalar_one()
    if job.state is JobState.running:
        step_job(connection, job_id, JobState.cancelling, now)
    if not live:
        step_job(connection, job_id, JobState.cancelled, now)
    return find_job(connection, job_id)


def drop_queued_blocks(connection: Connection, job_id: str, *, untouched: bool) -> None:
    """Cancel a job's queued blocks, or those no worker ever held; forget their wake-ups."""
    block, outbox = tables.block, tables.outbox
    dropped = and_(block.c.job == job_id, block.c.state == BlockState.queued.value)
    if untouched:
        dropped = and_(dropped, block.c.attempt == 0)
    connection.execute(
        delete(outbox).where(exists().where(and_(block.c.id == outbox.c.block, dropped)))
    )
    connection.execute(update(block).where(dropped).values(state=BlockState.cancelled.value))
