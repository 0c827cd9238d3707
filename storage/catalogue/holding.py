"""Operations of a worker on a block while it holds it: keep it, record progress.

Every statement that changes a held block names the attempt that holds it. A worker that was
thought dead and comes back finds its attempt fenced: nothing it does counts any more.
"""

from typing import Any, Final, NamedTuple

from sqlalchemy import ColumnElement, and_, bindparam, case, func, select, update

from jointplay.storage.catalogue import solvers, tables
from jointplay.storage.catalogue.connections import Unit
from jointplay.storage.catalogue.errors import Fenced
from jointplay.storage.catalogue.records import Block, BlockState, Job, JobState, Verdict
from jointplay.storage.catalogue.rows import lock_job, record_event

_block = tables.block
_IS_HELD: Final = and_(
    _block.c.id == bindparam("of_block"),
    _block.c.attempt == bindparam("of_attempt"),
    _block.c.state == BlockState.running,
)
_HELD: Final = select(_block).where(_IS_HELD)


def _over_blocks(value: ColumnElement[Any]) -> ColumnElement[Any]:
    return select(value).where(_block.c.job == bindparam("of_job")).scalar_subquery()


_job = tables.job
_JOB_OF: Final = (
    select(_job)
    .join(_block, _block.c.job == _job.c.id)
    .where(_block.c.id == bindparam("of_block"))
    .with_for_update(of=_job, key_share=True)
)
_HELD_JOB: Final = (
    select(_job.c.id, _job.c.state, _job.c.owner)
    .join(_block, _block.c.job == _job.c.id)
    .where(_block.c.id == bindparam("of_block"))
    .with_for_update(of=_job, key_share=True)
)
_STATE: Final = select(_job.c.state).join(_block, _block.c.job == _job.c.id).where(_IS_HELD)
_WEIGHTED = func.sum(_block.c.count * _block.c.progress_fraction) / func.sum(_block.c.count)
_SUM: Final = (
    update(_job)
    .where(_job.c.id == bindparam("of_job"))
    .values(
        progress_fraction=_over_blocks(_WEIGHTED),
        progress_time=_over_blocks(func.max(_block.c.progress_time)),
        steps=_over_blocks(func.sum(_block.c.progress_steps)),
        activity=None,
    )
)


class HeldJob(NamedTuple):
    """A job that is locked until the unit ends, as far as its blocks need to know it."""

    id: str
    state: JobState
    owner: str


def change_held(unit: Unit, block_id: str, attempt: int, **values: Any) -> None:
    """Change a block that this attempt holds; Fenced if it does not."""
    change = update(_block).where(_IS_HELD).values(values)
    if not unit.execute(change, {"of_block": block_id, "of_attempt": attempt}).rowcount:
        raise Fenced(block_id, attempt)


def lock_held(unit: Unit, block_id: str, attempt: int) -> HeldJob:
    """Lock and return the job of a block; Fenced if there is no such block.

    What follows in the unit sees whatever others committed before.
    """
    row = unit.execute(_HELD_JOB, {"of_block": block_id}).one_or_none()
    if row is None:
        raise Fenced(block_id, attempt)
    return HeldJob(*row)


def job_of(unit: Unit, block_id: str) -> Job | None:
    """Lock and return the job of a block; none if there is no such block."""
    row = unit.execute(_JOB_OF, {"of_block": block_id}).one_or_none()
    return None if row is None else Job(**row._mapping)


def held(unit: Unit, block_id: str, attempt: int) -> Block:
    """Return a block that this attempt holds; Fenced if it does not."""
    asked = {"of_block": block_id, "of_attempt": attempt}
    row = unit.execute(_HELD, asked).one_or_none()
    if row is None:
        raise Fenced(block_id, attempt)
    return Block(**row._mapping)


def verdict(unit: Unit, block_id: str, attempt: int) -> Verdict:
    """Return whether this attempt should go on, reading only; Fenced if it lost the block."""
    asked = {"of_block": block_id, "of_attempt": attempt}
    state = unit.execute(_STATE, asked).scalar_one_or_none()
    if state is None:
        raise Fenced(block_id, attempt)
    return _verdict(state)


def _verdict(state: JobState) -> Verdict:
    return Verdict.go_on if state is JobState.running else Verdict.cancel


def heartbeat(unit: Unit, block_id: str, attempt: int, lease: float) -> Verdict:
    """Hold a block `lease` seconds longer; Fenced if it is held no more."""
    change_held(unit, block_id, attempt, lease_until=unit.now + lease)
    solvers.note_holder(unit, block_id)
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
    job = lock_held(unit, block_id, attempt)
    change_held(
        unit,
        block_id,
        attempt,
        lease_until=unit.now + lease,
        losses=case((_block.c.progress_fraction < fraction, 0), else_=_block.c.losses),
        progress_time=time,
        progress_fraction=fraction,
        **({} if steps is None else {"progress_steps": steps}),
    )
    sum_progress(unit, job.id)
    return _verdict(job.state)


def record_checkpoint(
    unit: Unit, block_id: str, attempt: int, *, watermark: int, checkpoint: str
) -> None:
    """Store a checkpoint that is durable on disk already; Fenced if the block is held no more."""
    change_held(unit, block_id, attempt, watermark=watermark, checkpoint=checkpoint)


def note_activity(unit: Unit, block_id: str, attempt: int, activity: str) -> None:
    """Show a word for what the job is busy with until it advances; or Fenced.

    It is recorded as an event, too. For what takes long and has no progress: compiling.
    """
    verdict(unit, block_id, attempt)
    held = select(_block.c.job).where(_block.c.id == block_id)
    job = lock_job(unit, unit.execute(held).scalar_one())
    unit.execute(update(tables.job).where(tables.job.c.id == job.id).values(activity=activity))
    record_event(unit, job.id, activity, {"block": block_id, "attempt": attempt})


def sum_progress(unit: Unit, job_id: str) -> None:
    """Store how far a job is: the mean over its blocks, weighted with their points."""
    unit.execute(_SUM, {"of_job": job_id})
