"""Workers that were heard of lately, and the blocks that each of them has."""

from dataclasses import dataclass

from sqlalchemy import and_, func, select

from jointplay.storage.catalogue import tables
from jointplay.storage.catalogue.connections import Unit
from jointplay.storage.catalogue.records import BlockState
from jointplay.storage.catalogue.solvers import PATIENCE


@dataclass(frozen=True)
class HeldBlock:
    """A block that a worker has."""

    job: str
    owner: str  # of the job
    index: int  # among the job's blocks, from 0
    attempt: int
    since: float


@dataclass(frozen=True)
class WorkerAtWork:
    """One process that takes blocks."""

    name: str
    version: str
    processor: str
    since: float | None  # None: it was there before this was kept
    seen: float
    device: str | None  # see `WorkerDevice`; None: it has none
    rate: float | None
    lanes: int | None
    blocks: tuple[HeldBlock, ...]


@dataclass(frozen=True)
class Devices:
    """All devices of one name that workers have."""

    count: int
    rate: float  # accepted steps a second, of all of them
    lanes: int


def devices(unit: Unit) -> dict[str, Devices]:
    """Return the devices of workers that were heard of in the last minute, by the maker's name."""
    worker = tables.worker
    found = (
        select(worker.c.device, func.count(), func.sum(worker.c.rate), func.sum(worker.c.lanes))
        .where(worker.c.device.is_not(None), worker.c.seen > unit.now - PATIENCE)
        .group_by(worker.c.device)
        .order_by(worker.c.device)
    )
    return {
        name: Devices(count, float(rate), int(lanes))
        for name, count, rate, lanes in unit.execute(found)
    }


def workers_at_work(unit: Unit) -> tuple[WorkerAtWork, ...]:
    """Return workers by name; one that has been silent for a minute is left out."""
    worker, block, attempt, job = tables.worker, tables.block, tables.attempt, tables.job
    lately = select(worker).where(worker.c.seen > unit.now - PATIENCE).order_by(worker.c.name)
    this_one = and_(attempt.c.block == block.c.id, attempt.c.number == block.c.attempt)
    rows = unit.execute(
        select(block.c.worker, block.c.job, job.c.owner, block.c.index, attempt.c.number)
        .add_columns(attempt.c.started)
        .join(attempt, this_one)
        .join(job, job.c.id == block.c.job)
        .where(block.c.state == BlockState.running)
        .order_by(block.c.job, block.c.index)
    )
    held: dict[str, list[HeldBlock]] = {}
    for name, *facts in rows:
        held.setdefault(name, []).append(HeldBlock(*facts))
    return tuple(
        WorkerAtWork(blocks=tuple(held.get(one.name, ())), **one._asdict())
        for one in unit.execute(lately)
    )
