"""The end of an attempt at a block: it is finished, given back, put off, or lost.

With its last block a job ends; what is given back is queued again.
"""

from collections import Counter
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, Final

from sqlalchemy import bindparam, func, insert, select, update

from jointplay.records.job import JobError
from jointplay.storage.catalogue import tables, tally, usage
from jointplay.storage.catalogue.connections import Unit
from jointplay.storage.catalogue.counters import of_outcome
from jointplay.storage.catalogue.holding import (
    HeldJob,
    change_held,
    job_of,
    lock_held,
    sum_progress,
)
from jointplay.storage.catalogue.records import RECOVERED_QUEUE, BlockEnd, BlockState, JobState
from jointplay.storage.catalogue.rows import record_event, step_job
from jointplay.storage.catalogue.solvers import last_heard_of, machine_of, workers
from jointplay.storage.catalogue.submission import drop_blocks

_PUT_OFF: Final = "put-off"
_LOST: Final = "lost"
_REFUSED: Final = "refused"
_CUT_OFF: Final = "cut-off"
_LONGEST_RETREAT: Final = 60.0  # s
_DOUBLINGS: Final = 16  # of a pause, which is longer than the longest then
MOST_CUT_OFF: Final = 100
"""Attempts at a block that may be cut off: the service was away as often, or a worker lies."""
_FIRST_PAUSE = 2.0  # s
LONGEST_PAUSE: Final = 5.0
"""Seconds after which a block that was put off is tried again at the latest."""
_block, _attempt = tables.block, tables.attempt
_STATES: Final = select(_block.c.state).where(_block.c.job == bindparam("of_job")).distinct()
_END: Final = (
    update(_attempt)
    .where(_attempt.c.block == bindparam("of_block"), _attempt.c.number == bindparam("of_number"))
    .values(ended=bindparam("moment"), outcome=bindparam("ending"))
    .returning(_attempt.c.worker, _attempt.c.started)
)


def finish(unit: Unit, block_id: str, attempt: int, end: BlockEnd) -> JobState:
    """End a held block and, with its last block, the job. Returns the job's state after it.

    Raises
    ------
    Fenced
        The block is held no more; nothing was changed.
    ValueError
        The block ends as cancelled, of a job that nobody cancelled; nothing was changed.
    """
    reached = {
        "progress_time": end.time,
        "progress_fraction": end.fraction,
        "progress_steps": end.steps,
    }
    changes = {name: value for name, value in reached.items() if value is not None}
    job = lock_held(unit, block_id, attempt)
    change_held(unit, block_id, attempt, state=end.outcome, lease_until=None, **changes)
    if end.outcome is BlockState.cancelled and job.state is JobState.running:
        raise ValueError(f"job {job.id} was not asked to be cancelled")
    _end_attempt(unit, job, block_id, attempt, end.outcome.value)
    sum_progress(unit, job.id)
    return settle(unit, job.id, end.error) or job.state


def settle(unit: Unit, job_id: str, error: JobError | None) -> JobState | None:
    """End the job if nothing of it is left to do, or at once if a block failed.

    When only the block that seals is left, it is queued, ahead of blocks that never started.
    Returns the state in which the job ended; none if it did not, or had ended.
    """
    if error is not None:
        drop_blocks(unit, _block.c.job == job_id, untouched=False)
        end = JobState.failed
        return end if step_job(unit, job_id, end, error=error) else None
    states = set(unit.execute(_STATES, {"of_job": job_id}).scalars())
    if states == {BlockState.done, BlockState.waiting}:
        _queue_waiting(unit, job_id)
    elif not states & {BlockState.queued, BlockState.running}:
        end = JobState.succeeded if states == {BlockState.done} else JobState.cancelled
        return end if step_job(unit, job_id, end) else None
    return None


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
    _requeue(
        unit, block_id, job, min(_FIRST_PAUSE * 2.0 ** min(in_vain, _DOUBLINGS), LONGEST_PAUSE)
    )


def _requeue(unit: Unit, block_id: str, job: HeldJob, pause: float = 0.0) -> None:
    """Queue a block that was given back, to be claimed after a pause [s]."""
    if job.state.terminal:
        drop_blocks(unit, _block.c.job == job.id, untouched=False)
    else:
        queue_again(unit, block_id, pause)


def lose(unit: Unit, block_id: str, attempt: int, max_attempts: int) -> BlockState:
    """Take a block from a worker whose lease ran out; queue it again or give it up.

    It is given up when `max_attempts` machines have lost it, or each that is present has so often:
    one that loses it again and again counts once, as long as another one could compute it. Those
    that may be cut off, as they were not heard of since, do not count.

    Returns
    -------
    BlockState
        What became of the block: queued, failed, or cancelled if the job was being cancelled.
    """
    job = _take_back(unit, block_id, attempt, _LOST, losses=_block.c.losses + 1)
    losses = unit.execute(select(_block.c.losses).where(_block.c.id == block_id)).scalar_one()
    rows = _ended_by(unit, block_id, _LOST, losses)
    heard = last_heard_of(unit)
    lost = Counter(
        machine
        for machine, ended in rows
        if ended == unit.now or heard.get(machine, ended) >= ended
    )
    error = JobError(
        "platform",
        "worker-lost",
        f"{losses} workers in a row disappeared while computing this; their logs say why, or"
        " those of their machines where memory ran out. Submit it again once that is solved.",
    )
    in_vain = losses - len(dict(rows))  # a machine may lose it in vain: give another one time
    return _again(unit, job, block_id, lost, in_vain, max_attempts, error)


def refuse(unit: Unit, block_id: str, attempt: int, max_attempts: int, reason: str) -> BlockState:
    """Take a block from a worker whose results are not the job's; or Fenced.

    It begins anew, or is given up, as one that was lost; nothing that the attempt left counts.
    `reason` : a sentence without its end, for the block's history.
    """
    nothing = {"checkpoint": None, "watermark": 0}
    job = _take_back(unit, block_id, attempt, _REFUSED, {"reason": reason}, **nothing)
    refused = Counter(machine for machine, _ in _ended_by(unit, block_id, _REFUSED, None))
    error = JobError(
        "platform",
        "results-refused",
        f"Results of {refused.total()} attempts are not this job's, of the last one since"
        f" {reason}. Look at the workers that sent them, then submit it again.",
    )
    in_vain = refused.total() - len(refused)
    return _again(unit, job, block_id, refused, in_vain, max_attempts, error)


def _again(
    unit: Unit,
    job: HeldJob,
    block_id: str,
    lost: Counter[str],
    in_vain: int,
    max_attempts: int,
    error: JobError,
) -> BlockState:
    """Queue a block again that was taken back, or give it up: see `lose`.

    `lost` : attempts that count, by machine; `in_vain` : those of machines that had one before.
    """
    present = {machine_of(name) for name in workers(unit)} or lost.keys()
    hopeless = len(lost) >= max_attempts or all(lost[one] >= max_attempts for one in present)
    if not hopeless and not job.state.terminal:
        queue_again(
            unit,
            block_id,
            min(2.0 ** min(in_vain, _DOUBLINGS), _LONGEST_RETREAT) if in_vain else 0.0,
        )
        return BlockState.queued
    given_up = BlockState.failed if job.state is JobState.running else BlockState.cancelled
    unit.execute(update(_block).where(_block.c.id == block_id).values(state=given_up))
    settle(unit, job.id, error if given_up is BlockState.failed else None)
    return given_up


def note_cut_off(unit: Unit, block_id: str, attempt: int, owner: str) -> None:
    """Count a loss no more whose worker, of a name that begins with `owner`, is back.

    It lived, and could not reach whoever keeps the catalogue.
    """
    table = tables.attempt
    if job_of(unit, block_id) is None:
        return
    of_block = select(func.count()).where(table.c.block == block_id)
    if unit.execute(of_block.where(table.c.outcome == _CUT_OFF)).scalar_one() >= MOST_CUT_OFF:
        return
    lost = (table.c.block == block_id) & (table.c.number == attempt) & (table.c.outcome == _LOST)
    back = update(table).where(lost, table.c.worker.startswith(owner, autoescape=True))
    if unit.execute(back.values(outcome=_CUT_OFF)).rowcount:
        counted = (_block.c.id == block_id) & (_block.c.losses > 0)
        unit.execute(update(_block).where(counted).values(losses=_block.c.losses - 1))


def _ended_by(unit: Unit, block_id: str, outcome: str, last: int | None) -> list[tuple[str, float]]:
    """Return machine and end of attempts at a block that ended so, the last ones or all."""
    table = tables.attempt
    rows = unit.execute(
        select(table.c.worker, table.c.ended)
        .where(table.c.block == block_id, table.c.outcome == outcome)
        .order_by(table.c.number.desc())
        .limit(last)
    )
    return [(machine_of(row.worker), row.ended) for row in rows]


def _take_back(
    unit: Unit,
    block_id: str,
    attempt: int,
    outcome: str,
    about: Mapping[str, Any] = MappingProxyType({}),
    **changes: Any,
) -> HeldJob:
    """End an attempt without a result and return its job; Fenced if it does not hold the block.

    `about` : facts for the event of it.
    """
    free = {"state": BlockState.queued, "lease_until": None, "worker": None}
    job = lock_held(unit, block_id, attempt)
    change_held(unit, block_id, attempt, **free, **changes)
    worker = _end_attempt(unit, job, block_id, attempt, outcome)
    sum_progress(unit, job.id)
    facts = {"block": block_id, "attempt": attempt, "worker": worker, **about}
    record_event(unit, job.id, outcome, facts)
    return job


def queue_again(unit: Unit, block_id: str, pause: float = 0.0) -> None:
    """Have a worker woken for a block after a pause [s], ahead of jobs that never started."""
    job = tables.job
    of_job = select(job.c.owner).join(_block, _block.c.job == job.c.id)
    times = {"created": unit.now, "due": unit.now + pause, "tries": 0}
    unit.execute(
        insert(tables.outbox).values(
            block=block_id,
            queue=RECOVERED_QUEUE,
            owner=of_job.where(_block.c.id == block_id).scalar_subquery(),
            **times,
        )
    )


def _end_attempt(unit: Unit, job: HeldJob, block_id: str, attempt: int, outcome: str) -> str:
    """End an attempt, and return the name of its worker."""
    of_attempt = {"of_block": block_id, "of_number": attempt}
    row = unit.execute(_END, {**of_attempt, "moment": unit.now, "ending": outcome}).one()
    tally.add(unit, of_outcome(outcome), row.worker)
    if job.owner:
        usage.add(unit, job.owner, row.worker, max(unit.now - row.started, 0.0))
    return str(row.worker)
