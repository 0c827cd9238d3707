"""Work to do and workers at it, counted for whoever watches the service."""

from collections.abc import Mapping
from dataclasses import dataclass

from sqlalchemy import func, select

from jointplay.storage.catalogue import tables
from jointplay.storage.catalogue.connections import Unit
from jointplay.storage.catalogue.records import LIVE, BlockState, JobState
from jointplay.storage.catalogue.upkeep import on_the_way


@dataclass(frozen=True)
class Waiting:
    """Blocks of one queue that no worker has taken yet."""

    blocks: int
    longest: float  # s, that the first of them has waited


@dataclass(frozen=True)
class Census:
    """Numbers of one moment. What has ended is not counted: that would take ever longer."""

    jobs: Mapping[JobState, int]  # those that have not ended
    waiting: Mapping[str, Waiting]  # by queue
    running: int  # blocks that a worker has
    overdue: int  # ... of those, whose lease ran out and is not taken back yet
    losses: int  # workers that blocks which have not ended lost in a row
    on_the_way: int  # wake-ups that were sent and not answered yet


def census(unit: Unit) -> Census:
    """Count by index; the cost is that of what is live."""
    job, block, outbox = tables.job, tables.block, tables.outbox
    states = select(job.c.state, func.count()).where(job.c.state.in_(LIVE)).group_by(job.c.state)
    jobs = dict.fromkeys(LIVE, 0) | {row[0]: row[1] for row in unit.execute(states)}
    queues = select(outbox.c.queue, func.count(), func.min(outbox.c.created))
    waiting = {
        queue: Waiting(count, max(unit.now - first, 0.0))
        for queue, count, first in unit.execute(queues.group_by(outbox.c.queue))
    }
    held = block.c.state == BlockState.running
    running = unit.execute(select(func.count()).select_from(block).where(held)).scalar_one()
    late = select(func.count()).select_from(block).where(held, block.c.lease_until < unit.now)
    live = block.c.state.in_((BlockState.queued, BlockState.running))
    lost = select(func.coalesce(func.sum(block.c.losses), 0)).where(live)
    return Census(
        jobs,
        waiting,
        running,
        unit.execute(late).scalar_one(),
        int(unit.execute(lost).scalar_one()),
        on_the_way(unit),
    )
