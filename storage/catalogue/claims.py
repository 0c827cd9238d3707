"""Claims: a worker takes a block, one that it names or the one whose turn it is."""

from collections.abc import Sequence

from sqlalchemy import delete, func, insert, select, update

from jointplay.storage.catalogue import functions, quotas, solvers, tables, turns
from jointplay.storage.catalogue.connections import Unit
from jointplay.storage.catalogue.databases.postgresql import take_turns
from jointplay.storage.catalogue.records import (
    Block,
    BlockState,
    Claim,
    JobState,
    Solver,
    number_of,
)
from jointplay.storage.catalogue.rows import lock_job, record_event, step_job

_block = tables.block
_COUNTED = number_of("running", "")


def claim_next(
    unit: Unit,
    worker: str,
    lease: float,
    solver: Solver,
    *,
    most_running: int = 0,
    woken_for: str | None = None,
) -> Claim | None:
    """Take the block whose turn it is, of those that this solver may; none if none waits.

    Owners of whose blocks `most_running` are computed are passed by; 0: any number may be. A worker
    that was `woken_for` a block and takes another one has that one announced again.
    """
    if most_running:  # counted by one after the other
        take_turns(unit.connection, _COUNTED)
    busy = quotas.busy_owners(unit, most_running)
    if unit.shared:
        found = functions.claim_next(unit, worker, lease, solver, busy)
    else:
        found = _first(unit, solvers.waiting_for(unit, solver, busy), worker, lease, solver)
    if found is None:
        found = _first(unit, solvers.abandoned(unit, solver, busy), worker, lease, solver)
    if woken_for is not None and (found is None or found.block.id != woken_for):
        solvers.announce_again(unit, woken_for, solver)
    return found


def _first(
    unit: Unit, blocks: Sequence[str], worker: str, lease: float, solver: Solver
) -> Claim | None:
    claims = (claim(unit, block, worker, lease, solver) for block in blocks)
    return next((one for one in claims if one is not None), None)


def claim(
    unit: Unit, block_id: str, worker: str, lease: float, solver: Solver | None = None
) -> Claim | None:
    """Take a queued block for `lease` seconds; none if there is nothing (left) to do.

    With a `solver` only a block of a job that is its own, or that no worker's solver is any more.
    """
    taken = functions.claim if unit.shared else _claim
    found = taken(unit, block_id, worker, lease, solver)
    if found is None and solver is not None:
        if solvers.take_over(unit, block_id, solver):
            return taken(unit, block_id, worker, lease, solver)
        solvers.announce_again(unit, block_id, solver)
    return found


def _claim(
    unit: Unit, block_id: str, worker: str, lease: float, solver: Solver | None
) -> Claim | None:
    """Do what the function of `functions` does."""
    job_id = unit.execute(select(_block.c.job).where(_block.c.id == block_id)).scalar_one_or_none()
    if job_id is None:
        return None
    job = lock_job(unit, job_id)
    if job.state.terminal or not (solver is None or solvers.fits(job, solver)):
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
    outbox = tables.outbox
    gone = delete(outbox).where(outbox.c.block == block_id)
    for queue, turn in unit.execute(gone.returning(outbox.c.queue, outbox.c.turn)).all():
        if turn:
            turns.pass_by(unit, queue, turn)
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
            processor=job.processor or (solver and solver.processor),
        )
    )
    step_job(unit, job_id, JobState.running)
    claimed = {"block": held.id, "attempt": held.attempt, "worker": worker}
    record_event(unit, job_id, "claimed", claimed)
    return Claim(held, lock_job(unit, job_id))
