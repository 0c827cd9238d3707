"""Operations of a worker on a block: claim it, keep it, record its progress, give it back.

Every statement that changes a held block names the attempt that holds it. A worker that was
thought dead and comes back finds its attempt fenced: nothing it does counts any more.
"""

from typing import Any, Final

from sqlalchemy import ColumnElement, and_, case, delete, func, insert, select, update

from jointplay.records.job import JobError
from jointplay.storage.catalogue import tables
from jointplay.storage.catalogue.connections import Unit
from jointplay.storage.catalogue.errors import Fenced
from jointplay.storage.catalogue.records import Block, BlockState, Claim, Job, JobState, Verdict
from jointplay.storage.catalogue.rows import lock_job, record_event, step_job
from jointplay.storage.catalogue.submission import drop_blocks

RECOVERED_QUEUE = "recovered"
_PUT_OFF: Final = "put-off"
_FIRST_PAUSE = 2.0  # s
LONGEST_PAUSE: Final = 10.0
"""Seconds after which a block that was put off is tried again at the latest."""
_block = tables.block


def claim(unit: Unit, block_id: str, worker: str, lease: float) -> Claim | None:
    """Take a queued block for `lease` seconds; none if there is nothing (left) to do."""
    job_id = unit.execute(select(_block.c.job).where(_block.c.id == block_id)).scalar_one_or_none()
    if job_id is None:
        return None
    job = lock_job(unit, job_id)
    if job.state.terminal:
        return None
    row = unit.execute(
        update(_block)
        .where(_block.c.id == block_id, _block.c.state == BlockState.queued)
        .values(
            state=BlockState.running,
            attempt=_block.c.attempt + 1,
            lease_until=unit.now + lease,
            worker=worker,
        )
        .returning(*_block.c)
    ).one_or_none()
    if row is None:
        return None
    held = Block(**row._mapping)
    unit.execute(delete(tables.outbox).where(tables.outbox.c.block == block_id))
    unit.execute(
        insert(tables.attempt).values(
            block=block_id, number=held.attempt, worker=worker, started=unit.now
        )
    )
    unit.execute(
        update(tables.job)
        .where(tables.job.c.id == job_id)
        .values(
            attempt=max(job.attempt, held.attempt),
            started=func.coalesce(tables.job.c.started, unit.now),
        )
    )
    step_job(unit, job_id, JobState.running)
    claimed = {"block": held.id, "attempt": held.attempt, "worker": worker}
    record_event(unit, job_id, "claimed", claimed)
    return Claim(held, lock_job(unit, job_id))


def _is_held(block_id: str, attempt: int) -> ColumnElement[bool]:
    columns = (_block.c.id == block_id, _block.c.attempt == attempt)
    return and_(*columns, _block.c.state == BlockState.running)


def _change_held(unit: Unit, block_id: str, attempt: int, **values: Any) -> str:
    """Change a block this attempt holds and return its job; Fenced if it does not hold it."""
    change = update(_block).where(_is_held(block_id, attempt)).values(values)
    job_id = unit.execute(change.returning(_block.c.job)).scalar_one_or_none()
    if job_id is None:
        raise Fenced(block_id, attempt)
    return str(job_id)


def verdict(unit: Unit, block_id: str, attempt: int) -> Verdict:
    """Return whether this attempt should go on, reading only; Fenced if it lost the block."""
    state = unit.execute(
        select(tables.job.c.state)
        .join(_block, _block.c.job == tables.job.c.id)
        .where(_is_held(block_id, attempt))
    ).scalar_one_or_none()
    if state is None:
        raise Fenced(block_id, attempt)
    return Verdict.go_on if state is JobState.running else Verdict.cancel


def heartbeat(unit: Unit, block_id: str, attempt: int, lease: float) -> Verdict:
    """Hold a block `lease` seconds longer; Fenced if it is held no more."""
    _change_held(unit, block_id, attempt, lease_until=unit.now + lease)
    return verdict(unit, block_id, attempt)


def record_progress(
    unit: Unit,
    block_id: str,
    attempt: int,
    lease: float,
    *,
    time: float,
    fraction: float,
    steps: int | None = None,
) -> Verdict:
    """Heartbeat that also stores simulated time [s], fraction (0..1) and steps; or Fenced.

    Coming further than any attempt before ends a row of losses.
    """
    job_id = _change_held(
        unit,
        block_id,
        attempt,
        lease_until=unit.now + lease,
        losses=case((_block.c.progress_fraction < fraction, 0), else_=_block.c.losses),
        progress_time=time,
        progress_fraction=fraction,
        **({} if steps is None else {"progress_steps": steps}),
    )
    _sum_progress(unit, job_id)
    return verdict(unit, block_id, attempt)


def record_checkpoint(
    unit: Unit, block_id: str, attempt: int, *, watermark: int, checkpoint: str
) -> None:
    """Store a checkpoint that is durable on disk already; Fenced if the block is held no more."""
    _change_held(unit, block_id, attempt, watermark=watermark, checkpoint=checkpoint)


def note_activity(unit: Unit, block_id: str, attempt: int, activity: str) -> None:
    """Show a word for what the job is busy with until it advances; or Fenced.

    It is recorded as an event, too. For what takes long and has no progress: compiling.
    """
    verdict(unit, block_id, attempt)
    held = select(_block.c.job).where(_block.c.id == block_id)
    job = lock_job(unit, unit.execute(held).scalar_one())
    unit.execute(update(tables.job).where(tables.job.c.id == job.id).values(activity=activity))
    record_event(unit, job.id, activity, {"block": block_id, "attempt": attempt})


def _sum_progress(unit: Unit, job_id: str) -> None:
    weighted = func.sum(_block.c.count * _block.c.progress_fraction) / func.sum(_block.c.count)
    steps_of_all = func.sum(_block.c.progress_steps)
    fraction, time, steps = unit.execute(
        select(weighted, func.max(_block.c.progress_time), steps_of_all).where(
            _block.c.job == job_id
        )
    ).one()
    unit.execute(
        update(tables.job)
        .where(tables.job.c.id == job_id)
        .values(progress_fraction=fraction, progress_time=time, steps=steps, activity=None)
    )


def finish(
    unit: Unit,
    block_id: str,
    attempt: int,
    outcome: BlockState,
    error: JobError | None = None,
    *,
    time: float | None = None,
    fraction: float | None = None,
    steps: int | None = None,
) -> JobState:
    """End a held block (done, failed or cancelled) and, with its last block, the job.

    `time` [s], `fraction` (0..1) and `steps` say how far it came, if that is known; a block that
    is done came all the way.

    Returns
    -------
    JobState
        The job's state after it.

    Raises
    ------
    Fenced
        The block is held no more; nothing was changed.
    """
    changes: dict[str, Any] = {"state": outcome, "lease_until": None}
    if time is not None:
        changes["progress_time"] = time
    if steps is not None:
        changes["progress_steps"] = steps
    if outcome is BlockState.done:
        fraction = 1.0
    if fraction is not None:
        changes["progress_fraction"] = fraction
    job_id = _change_held(unit, block_id, attempt, **changes)
    job = lock_job(unit, job_id)
    if (outcome is BlockState.failed) != (error is not None):
        raise ValueError("a failed block, and no other, has an error")
    if outcome is BlockState.cancelled and job.state is JobState.running:
        raise ValueError(f"job {job_id} was not asked to be cancelled")
    _end_attempt(unit, block_id, attempt, outcome.value)
    _sum_progress(unit, job_id)
    return settle(unit, job_id, error)


def settle(unit: Unit, job_id: str, error: JobError | None) -> JobState:
    """End the job if nothing of it is left to do, or at once if a block failed.

    When only the block that seals is left, it is queued, ahead of blocks that never started.
    """
    if error is not None:
        drop_blocks(unit, _block.c.job == job_id, untouched=False)
        step_job(unit, job_id, JobState.failed, error=error)
        return lock_job(unit, job_id).state
    of_job = select(_block.c.state).where(_block.c.job == job_id).distinct()
    states = set(unit.execute(of_job).scalars())
    if states == {BlockState.done, BlockState.waiting}:
        _queue_waiting(unit, job_id)
    elif not states & {BlockState.queued, BlockState.running}:
        all_done = states == {BlockState.done}
        step_job(unit, job_id, JobState.succeeded if all_done else JobState.cancelled)
    return lock_job(unit, job_id).state


def _queue_waiting(unit: Unit, job_id: str) -> None:
    queued = unit.execute(
        update(_block)
        .where(_block.c.job == job_id, _block.c.state == BlockState.waiting)
        .values(state=BlockState.queued)
        .returning(_block.c.id)
    )
    for block_id in queued.scalars().all():
        queue_again(unit, block_id)


def release(unit: Unit, block_id: str, attempt: int) -> None:
    """Give a held block back unfinished, to be resumed by a free worker; or Fenced.

    It is not a loss.
    """
    _requeue(unit, block_id, _take_back(unit, block_id, attempt, "released"))


def put_off(unit: Unit, block_id: str, attempt: int, activity: str) -> None:
    """Give a held block back because of a fault that may pass, such as a full disk; or Fenced.

    It is not a loss. Until it is tried again, after ever longer pauses while the fault lasts,
    the job shows `activity`, a few words for what it waits for.
    """
    table = tables.attempt
    worked = select(func.coalesce(func.max(table.c.number), 0)).where(
        table.c.block == block_id, table.c.number < attempt, table.c.outcome != _PUT_OFF
    )
    in_vain = attempt - 1 - unit.execute(worked).scalar_one()
    job = _take_back(unit, block_id, attempt, _PUT_OFF)
    unit.execute(update(tables.job).where(tables.job.c.id == job.id).values(activity=activity))
    _requeue(unit, block_id, job, min(_FIRST_PAUSE * 2.0**in_vain, LONGEST_PAUSE))


def _requeue(unit: Unit, block_id: str, job: Job, pause: float = 0.0) -> None:
    """Queue a block that was given back, to be claimed after a pause [s]."""
    if job.state.terminal:
        drop_blocks(unit, _block.c.job == job.id, untouched=False)
    else:
        queue_again(unit, block_id, pause)


def lose(unit: Unit, block_id: str, attempt: int, max_attempts: int) -> BlockState:
    """Take a block from a worker whose lease ran out; queue it again or give it up.

    Returns
    -------
    BlockState
        What became of the block: queued, failed, or cancelled if the job was being cancelled.
    """
    job = _take_back(unit, block_id, attempt, "lost", losses=_block.c.losses + 1)
    losses = unit.execute(select(_block.c.losses).where(_block.c.id == block_id)).scalar_one()
    if losses < max_attempts and not job.state.terminal:
        queue_again(unit, block_id)
        return BlockState.queued
    given_up = BlockState.failed if job.state is JobState.running else BlockState.cancelled
    unit.execute(update(_block).where(_block.c.id == block_id).values(state=given_up))
    error = JobError(
        "platform",
        "worker-lost",
        f"{losses} workers in a row disappeared while computing this; the worker's log says why"
        " (out of memory is the usual reason). Submit it again once that is solved.",
    )
    settle(unit, job.id, error if given_up is BlockState.failed else None)
    return given_up


def _take_back(unit: Unit, block_id: str, attempt: int, outcome: str, **changes: Any) -> Job:
    """End an attempt without a result and return its job; Fenced if it does not hold the block."""
    free = {"state": BlockState.queued, "lease_until": None, "worker": None}
    job_id = _change_held(unit, block_id, attempt, **free, **changes)
    job = lock_job(unit, job_id)
    _end_attempt(unit, block_id, attempt, outcome)
    _sum_progress(unit, job_id)
    record_event(unit, job_id, outcome, {"block": block_id, "attempt": attempt})
    return job


def queue_again(unit: Unit, block_id: str, pause: float = 0.0) -> None:
    """Have a worker woken for a block after a pause [s], ahead of jobs that never started."""
    due = unit.now + pause
    unit.execute(
        insert(tables.outbox).values(
            block=block_id, queue=RECOVERED_QUEUE, created=unit.now, due=due, tries=0
        )
    )


def _end_attempt(unit: Unit, block_id: str, attempt: int, outcome: str) -> None:
    table = tables.attempt
    unit.execute(
        update(table)
        .where(table.c.block == block_id, table.c.number == attempt)
        .values(ended=unit.now, outcome=outcome)
    )
