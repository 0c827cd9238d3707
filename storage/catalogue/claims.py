"""Claims: a worker takes a block, one that it names or the one whose turn it is."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, Final

from sqlalchemy import bindparam, delete, insert, update

from jointplay.storage.catalogue import calls, fair_queueing, quotas, solvers, tables
from jointplay.storage.catalogue.connections import Unit
from jointplay.storage.catalogue.databases.postgresql import lock_numbers
from jointplay.storage.catalogue.holding import job_of
from jointplay.storage.catalogue.numbers import number_of
from jointplay.storage.catalogue.records import Block, BlockState, Claim, JobState, Solver
from jointplay.storage.catalogue.rows import record_event

_block, _job, _outbox = tables.block, tables.job, tables.outbox
_TAKE: Final = (
    update(_block)
    .where(_block.c.id == bindparam("of_block"), _block.c.state == BlockState.queued)
    .values(
        state=BlockState.running,
        attempt=_block.c.attempt + 1,
        lease_until=bindparam("until"),
        worker=bindparam("claimant"),
    )
    .returning(*_block.c)
)
_SENT: Final = delete(_outbox).where(_outbox.c.block == bindparam("of_block"))
_BEGIN: Final = insert(tables.attempt).values(
    block=bindparam("of_block"),
    number=bindparam("number_of"),
    worker=bindparam("claimant"),
    started=bindparam("moment"),
    account=bindparam("of_account"),
    charged=bindparam("paid"),
)
_CHANGE: Final = (
    update(_job)
    .where(_job.c.id == bindparam("of_job"))
    .values(
        {
            name: bindparam(f"now_{name}", type_=_job.c[name].type)
            for name in ("attempt", "started", "processor", "state")
        }
    )
)
_COUNTED = number_of("running", "")


def claim_next(
    unit: Unit,
    worker: str,
    lease: float,
    solver: Solver,
    *,
    most_running: int = 0,
) -> Claim | None:
    """Take the block whose turn it is, of those that this solver may; none if none waits.

    Owners of whose blocks `most_running` are computed are passed by; 0: any number may be.
    """
    if most_running:  # counted by one after the other
        lock_numbers(unit.connection, _COUNTED)
    busy = quotas.busy_owners(unit, most_running)
    if unit.shared:
        found = calls.claim_next(unit, worker, lease, solver, busy)
    else:
        found = _first(unit, solvers.waiting_for(unit, solver, busy), worker, lease, solver)
    if found is None:
        found = _first(unit, solvers.abandoned(unit, solver, busy), worker, lease, solver)
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
    taken = calls.claim if unit.shared else _claim
    found = taken(unit, block_id, worker, lease, solver)
    if found is None and solver is not None and solvers.take_over(unit, block_id, solver):
        return taken(unit, block_id, worker, lease, solver)
    return found


def _claim(
    unit: Unit, block_id: str, worker: str, lease: float, solver: Solver | None
) -> Claim | None:
    """Do what PostgreSQL does by itself."""
    job = job_of(unit, block_id)
    if job is None or job.state.terminal or not (solver is None or solvers.fits(job, solver)):
        return None
    moment, holder = {"moment": unit.now}, {"of_block": block_id, "claimant": worker}
    row = unit.execute(_TAKE, {**holder, "until": unit.now + lease}).one_or_none()
    if row is None:
        return None
    held = Block(**row._mapping)
    unit.execute(_SENT, {"of_block": block_id})
    charge = {"of_account": fair_queueing.ACCOUNT, "paid": fair_queueing.charge(unit, job.owner)}
    unit.execute(_BEGIN, {**holder, **moment, **charge, "number_of": held.attempt})
    begins = job.state is JobState.queued
    changes: dict[str, Any] = {
        "attempt": max(job.attempt, held.attempt),
        "started": unit.now if job.started is None else job.started,
        "processor": job.processor or (solver and solver.processor),
        "state": JobState.running if begins else job.state,
    }
    of_job = {f"now_{name}": value for name, value in changes.items()}
    unit.execute(_CHANGE, {"of_job": job.id, **of_job})
    if begins:
        record_event(unit, job.id, JobState.running.value, {})
    claimed = {"block": held.id, "attempt": held.attempt, "worker": worker}
    record_event(unit, job.id, "claimed", claimed)
    return Claim(held, replace(job, **changes))
