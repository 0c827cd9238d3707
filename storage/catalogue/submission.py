"""Accepting jobs and cancelling them: what users ask for."""

from collections.abc import Iterator, Sequence
from typing import Any

from sqlalchemy import (
    ColumnElement,
    Connection,
    Row,
    and_,
    delete,
    exists,
    func,
    insert,
    select,
    update,
)

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
from storage.catalogue.rows import find_job, lock_job, step_job

FRESH_QUEUE = "jobs"
_LONGEST_NAME = 200  # of a scene, as it is looked for
_REUSED = (JobState.queued.value, JobState.running.value, JobState.succeeded.value)
_LIVE = (BlockState.queued.value, BlockState.running.value)


def submit(
    connection: Connection,
    job_id: str,
    new: NewJob,
    key: SubmissionKey | None,
    now: float,
    *,
    reuse: bool,
) -> Submitted:
    """Store a job, its blocks and their wake-ups, or find the job an earlier request made."""
    if key is not None:
        earlier = earlier_answer(connection, key, now)
        if earlier is not None and earlier.job is not None:
            job = find_job(connection, earlier.job)
            # a key is stored with the job that it made, and later than one that it found
            return Submitted(job, created=False, cached=earlier.created > job.created)
    if reuse and (same := same_job(connection, new, now)) is not None:
        if key is not None:
            remember_key(connection, key, now, job=same)
        _keep_until(connection, same, new.expires)
        return Submitted(find_job(connection, same), created=False, cached=True)
    insert_jobs(connection, [(job_id, new)], now)
    if key is not None:
        remember_key(connection, key, now, job=job_id)
    return Submitted(find_job(connection, job_id), created=True)


def same_job(connection: Connection, new: NewJob, now: float) -> str | None:
    """Return the newest job that asks this solver for the same, unless it ended badly or expired.

    The digest covers the filled-in job without its label, the version the solver's sources.
    """
    columns = tables.job.c
    found = connection.execute(
        select(columns.id)
        .where(
            columns.digest == new.digest,
            columns.solver_version == new.solver_version,
            columns.kind == new.kind,
            columns.owner == new.owner,
            columns.state.in_(_REUSED),
            columns.expires.is_(None) | (columns.expires > now),
        )
        .order_by(columns.id.desc())
        .limit(1)
    )
    return found.scalar_one_or_none()


def _keep_until(connection: Connection, job_id: str, expires: float | None) -> None:
    """Let a job that is wanted again expire no sooner than the new request asks."""
    columns = tables.job.c
    of_job = update(tables.job).where(columns.id == job_id)
    if expires is None:
        connection.execute(of_job.values(expires=None))
    else:
        connection.execute(of_job.where(columns.expires < expires).values(expires=expires))


def insert_jobs(connection: Connection, jobs: Sequence[tuple[str, NewJob]], now: float) -> None:
    """Store new jobs with their ids, all their blocks, wake-ups and first events."""
    connection.execute(insert(tables.job), [_job_row(job_id, new, now) for job_id, new in jobs])
    blocks = [row for job_id, new in jobs for row in _block_rows(job_id, new)]
    connection.execute(insert(tables.block), blocks)
    connection.execute(
        insert(tables.outbox),
        [
            {"block": block["id"], "queue": FRESH_QUEUE, "created": now, "due": now, "tries": 0}
            for block in blocks
            if block["state"] == BlockState.queued.value
        ],
    )
    connection.execute(
        insert(tables.event),
        [
            {"job": job_id, "seq": 1, "time": now, "type": JobState.queued.value, "data": {}}
            for job_id, _ in jobs
        ],
    )


def _job_row(job_id: str, new: NewJob, now: float) -> dict[str, Any]:
    return {
        "id": job_id,
        "kind": new.kind,
        "owner": new.owner,
        "label": new.label,
        "batch": new.batch,
        "scene": None if new.scene is None else new.scene[:_LONGEST_NAME],
        "spec": new.spec,
        "digest": new.digest,
        "solver_version": new.solver_version,
        "result_schema": new.result_schema,
        "state": JobState.queued.value,
        "progress_time": 0.0,
        "progress_fraction": 0.0,
        "attempt": 0,
        "created": now,
        "expires": new.expires,
    }


def _block_rows(job_id: str, new: NewJob) -> Iterator[dict[str, Any]]:
    cuts = [(first, count, BlockState.queued) for first, count in new.blocks]
    if new.seal:
        first, count = new.blocks[-1]
        cuts.append((first + count, 0, BlockState.waiting))
    for index, (first, count, state) in enumerate(cuts):
        yield {
            "id": f"{job_id}-{index}",
            "job": job_id,
            "index": index,
            "first": first,
            "count": count,
            "state": state.value,
            "attempt": 0,
            "losses": 0,
            "watermark": 0,
            "progress_time": 0.0,
            "progress_fraction": 0.0,
        }


def earlier_answer(connection: Connection, key: SubmissionKey, now: float) -> Row[Any] | None:
    """Find what a key was answered with (its job or batch), if it is still remembered.

    Raises
    ------
    KeyReused
        It was used for another request.
    """
    table = tables.idempotency
    same_key = and_(table.c.owner == key.owner, table.c.key == key.key)
    row = connection.execute(select(table).where(same_key)).one_or_none()
    if row is None:
        return None
    if row.expires <= now or (row.job is None and row.batch is None):
        connection.execute(delete(table).where(same_key))
        return None
    if row.fingerprint != key.fingerprint:
        raise KeyReused(key.key)
    return row


def remember_key(
    connection: Connection,
    key: SubmissionKey,
    now: float,
    *,
    job: str | None = None,
    batch: str | None = None,
) -> None:
    """Have a key find this job or batch while it is remembered."""
    connection.execute(
        insert(tables.idempotency).values(
            owner=key.owner,
            key=key.key,
            fingerprint=key.fingerprint,
            job=job,
            batch=batch,
            created=now,
            expires=now + key.seconds,
        )
    )


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
    """Cancel a job's blocks that nobody holds, or that nobody ever held; forget their wake-ups."""
    drop_blocks(connection, tables.block.c.job == job_id, untouched=untouched)


def drop_blocks(connection: Connection, of: ColumnElement[bool], *, untouched: bool) -> None:
    """Cancel those blocks among some that nobody holds, or that nobody ever held."""
    block, outbox = tables.block, tables.outbox
    dropped = and_(of, block.c.state.in_((BlockState.queued.value, BlockState.waiting.value)))
    if untouched:
        dropped = and_(dropped, block.c.attempt == 0)
    connection.execute(
        delete(outbox).where(exists().where(and_(block.c.id == outbox.c.block, dropped)))
    )
    connection.execute(update(block).where(dropped).values(state=BlockState.cancelled.value))
