"""What a worker does with a block: claim it, keep it, record how far it is, give it back.

Every statement that changes a held block names the attempt that holds it. A worker that was
thought dead and comes back finds its attempt fenced: nothing it does counts any more.
"""

from typing import Any

from sqlalchemy import Connection, delete, func, insert, select, update

from jointplay.records.job import JobError
from jointplay.storage.catalogue import tables
from jointplay.storage.catalogue.errors import Fenced
from jointplay.storage.catalogue.records import BlockState, Claim, JobState, Verdict
from jointplay.storage.catalogue.rows import block_record, lock_job, record_event, step_job
from jointplay.storage.catalogue.submission import drop_queued_blocks

RECOVERED_QUEUE = "recovered"
_block = tables.block


def claim(
    connection: Connection, block_id: str, worker: str, lease: float, now: float
) -> Claim | None:
    """Take a queued block; none if somebody else has it or nobody needs it any more."""
    job_id = connection.execute(
        select(_block.c.job).where(_block.c.id == block_id)
    ).scalar_one_or_none()
    if job_id is None:
        return None
    job = lock_job(connection, job_id)
    if job.state.terminal:
        return None
    row = connection.execute(
        update(_block)
        .where(_block.c.id == block_id, _block.c.state == BlockState.queued.value)
        .values(
            state=BlockState.running.value,
            attempt=_block.c.attempt + 1,
            lease_until=now + lease,
            worker=worker,
        )
        .returning(*_block.c)
    ).one_or_none()
    if row is None:
        return None
    held = block_record(row)
    connection.execute(delete(tables.outbox).where(tables.outbox.c.block == block_id))
    connection.execute(
        insert(tables.attempt).values(
            block=block_id, number=held.attempt, worker=worker, started=now
        )
    )
    connection.execute(
        update(tables.job)
        .where(tables.job.c.id == job_id)
        .values(
            attempt=max(job.attempt, held.attempt),
            started=func.coalesce(tables.job.c.started, now),
        )
    )
    step_job(connection, job_id, JobState.running, now)
    record_event(
        connection,
        job_id,
        now,
        "claimed",
        {"block": held.id, "attempt": held.attempt, "worker": worker},
    )
    return Claim(held, lock_job(connection, job_id))


def _change_held(connection: Connection, block_id: str, attempt: int, **values: Any) -> str:
    """Change a block this attempt holds and return its job; Fenced if it does not hold it."""
    job_id = connection.execute(
        update(_block)
        .where(
            _block.c.id == block_id,
            _block.c.attempt == attempt,
            _block.c.state == BlockState.running.value,
        )
        .values(values)
        .returning(_block.c.job)
    ).scalar_one_or_none()
    if job_id is None:
        raise Fenced(block_id, attempt)
    return str(job_id)


def verdict(connection: Connection, block_id: str, attempt: int) -> Verdict:
    """Return whether this attempt should go on, reading only; Fenced if it lost the block."""
    state = connection.execute(
        select(tables.job.c.state)
        .join(_block, _block.c.job == tables.job.c.id)
        .where(
            _block.c.id == block_id,
            _block.c.attempt == attempt,
            _block.c.state == BlockState.running.value,
        )
    ).scalar_one_or_none()
    if state is None:
        raise Fenced(block_id, attempt)
    return Verdict.go_on if state == JobState.running.value else Verdict.cancel


def heartbeat(
    connection: Connection, block_id: str, attempt: int, lease: float, now: float
) -> Verdict:
    """Extend the lease."""
    _change_held(connection, block_id, attempt, lease_until=now + lease)
    return verdict(connection, block_id, attempt)


def record_progress(
    connection: Connection,
    block_id: str,
    attempt: int,
    lease: float,
    now: float,
    *,
    time: float,
    fraction: float,
    steps: int | None,
) -> Verdict:
    """Extend the lease and store how far the block, and with it the job, has come."""
    job_id = _change_held(
        connection,
        block_id,
        attempt,
        lease_until=now + lease,
        progress_time=time,
        progress_fraction=fraction,
        **({} if steps is None else {"progress_steps": steps}),
    )
    _sum_progress(connection, job_id)
    return verdict(connection, block_id, attempt)


def record_checkpoint(
    connection: Connection, block_id: str, attempt: int, *, watermark: int, checkpoint: str
) -> None:
    """Store where the block can be resumed; both must be durable on disk already."""
    _change_held(connection, block_id, attempt, watermark=watermark, checkpoint=checkpoint)


def note_activity(
    connection: Connection, block_id: str, attempt: int, activity: str, now: float
) -> None:
    """Show what the job is busy with until it advances, and record it as an event."""
    verdict(connection, block_id, attempt)
    held = select(_block.c.job).where(_block.c.id == block_id)
    job = lock_job(connection, connection.execute(held).scalar_one())
    connection.execute(
        update(tables.job).where(tables.job.c.id == job.id).values(activity=activity)
    )
    record_event(connection, job.id, now, activity, {"block": block_id, "attempt": attempt})


def _sum_progress(connection: Connection, job_id: str) -> None:
    weighted = func.sum(_block.c.count * _block.c.progress_fraction) / func.sum(_block.c.count)
    steps_of_all = func.sum(_block.c.progress_steps)
    fraction, time, steps = connection.execute(
        select(weighted, func.max(_block.c.progress_time), steps_of_all).where(
            _block.c.job == job_id
        )
    ).one()
    connection.execute(
        update(tables.job)
        .where(tables.job.c.id == job_id)
        .values(progress_fraction=fraction, progress_time=time, steps=steps, activity=None)
    )


def finish(
    connection: Connection,
    block_id: str,
    attempt: int,
    outcome: BlockState,
    error: JobError | None,
    now: float,
    *,
    time: float | None,
    fraction: float | None,
    steps: int | None,
) -> JobState:
    """End a held block (done, failed or cancelled) and, with its last block, the job.

    `time`, `fraction` and `steps` say how far it came; a block that is done came all the way.

    Returns
    -------
    JobState
        The job's state after it.
    """
    changes: dict[str, Any] = {"state": outcome.value, "lease_until": None}
    if time is not None:
        changes["progress_time"] = time
    if steps is not None:
        changes["progress_steps"] = steps
    if outcome is BlockState.done:
        fraction = 1.0
    if fraction is not None:
        changes["progress_fraction"] = fraction
    job_id = _change_held(connection, block_id, attempt, **changes)
    job = lock_job(connection, job_id)
    if (outcome is BlockState.failed) != (error is not None):
        raise ValueError("a failed block, and no other, has an error")
    if outcome is BlockState.cancelled and job.state is JobState.running:
        raise ValueError(f"nobody asked to cancel job {job_id}")
    _end_attempt(connection, block_id, attempt, outcome.value, now)
    _sum_progress(connection, job_id)
    return _settle(connection, job_id, error, now)


def _settle(connection: Connection, job_id: str, error: JobError | None, now: float) -> JobState:
    """End the job if nothing of it is left to do, or at once if a block failed.

    When only the block that seals is left, it is queued, ahead of blocks that never started.
    """
    if error is not None:
        drop_queued_blocks(connection, job_id, untouched=False)
        step_job(connection, job_id, JobState.failed, now, error=error)
        return lock_job(connection, job_id).state
    of_job = select(_block.c.state).where(_block.c.job == job_id).distinct()
    states = set(connection.execute(of_job).scalars())
    if states == {BlockState.done.value, BlockState.waiting.value}:
        _queue_waiting(connection, job_id, now)
    elif not states & {BlockState.queued.value, BlockState.running.value}:
        all_done = states == {BlockState.done.value}
        step_job(connection, job_id, JobState.succeeded if all_done else JobState.cancelled, now)
    return lock_job(connection, job_id).state


def _queue_waiting(connection: Connection, job_id: str, now: float) -> None:
    queued = connection.execute(
        update(_block)
        .where(_block.c.job == job_id, _block.c.state == BlockState.waiting.value)
        .values(state=BlockState.queued.value)
        .returning(_block.c.id)
    )
    for block_id in queued.scalars().all():
        queue_again(connection, block_id, now)


def release(connection: Connection, block_id: str, attempt: int, now: float) -> None:
    """Give a held block back unfinished, to be resumed by whoever is free; not a loss."""
    job_id = _change_held(
        connection,
        block_id,
        attempt,
        state=BlockState.queued.value,
        lease_until=None,
        worker=None,
    )
    job = lock_job(connection, job_id)
    _end_attempt(connection, block_id, attempt, "released", now)
    _sum_progress(connection, job_id)
    record_event(connection, job_id, now, "released", {"block": block_id, "attempt": attempt})
    if job.state.terminal:
        drop_queued_blocks(connection, job_id, untouched=False)
    else:
        queue_again(connection, block_id, now)


def lose(
    connection: Connection, block_id: str, attempt: int, max_attempts: int, now: float
) -> BlockState:
    """Take a block from a worker whose lease ran out; queue it again or give it up.

    Returns
    -------
    BlockState
        What became of the block: queued, failed, or cancelled if the job was being cancelled.
    """
    job_id = _change_held(
        connection,
        block_id,
        attempt,
        state=BlockState.queued.value,
        lease_until=None,
        worker=None,
        losses=_block.c.losses + 1,
    )
    job = lock_job(connection, job_id)
    _end_attempt(connection, block_id, attempt, "lost", now)
    _sum_progress(connection, job_id)
    record_event(connection, job_id, now, "lost", {"block": block_id, "attempt": attempt})
    losses = connection.execute(select(_block.c.losses).where(_block.c.id == block_id)).scalar_one()
    if losses < max_attempts and not job.state.terminal:
        queue_again(connection, block_id, now)
        return BlockState.queued
    given_up = BlockState.failed if job.state is JobState.running else BlockState.cancelled
    connection.execute(update(_block).where(_block.c.id == block_id).values(state=given_up.value))
    error = JobError(
        "platform",
        "worker-lost",
        f"{losses} workers in a row disappeared while computing this; the worker's log says why"
        " (out of memory is the usual reason). Submit it again once that is solved.",
    )
    _settle(connection, job_id, error if given_up is BlockState.failed else None, now)
    return given_up


def queue_again(connection: Connection, block_id: str, now: float) -> None:
    """Have a worker told of a block, ahead of jobs that never started."""
    connection.execute(
        insert(tables.outbox).values(
            block=block_id, queue=RECOVERED_QUEUE, created=now, due=now, tries=0
        )
    )


def _end_attempt(
    connection: Connection, block_id: str, attempt: int, outcome: str, now: float
) -> None:
    table = tables.attempt
    connection.execute(
        update(table)
        .where(table.c.block == block_id, table.c.number == attempt)
        .values(ended=now, outcome=outcome)
    )
