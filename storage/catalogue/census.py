"""Work to do and workers at it, counted for whoever watches the service."""

from collections.abc import Mapping
from dataclasses import dataclass

from sqlalchemy import func, select

from jointplay.storage.catalogue import tables, tally
from jointplay.storage.catalogue.at_work import Devices, devices
from jointplay.storage.catalogue.connections import Unit
from jointplay.storage.catalogue.records import LIVE, QUEUES, BlockState, JobState
from jointplay.storage.catalogue.solvers import count_unserved
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
    unserved: int  # jobs whose solver no worker has
    on_the_way: int  # wake-ups that were sent and not answered yet
    devices: Mapping[str, Devices]  # of workers, by the maker's name
    totals: Mapping[str, float]  # counters that never fall; see `storage.catalogue.tally`


def census(unit: Unit) -> Census:
    """Count by index; the cost is that of what is live."""
    job, block, outbox = tables.job, tables.block, tables.outbox
    states = select(job.c.state, func.count()).where(job.c.state.in_(LIVE)).group_by(job.c.state)
    jobs = dict.fromkeys(LIVE, 0) | {row[0]: row[1] for row in unit.execute(states)}
    queues = select(outbox.c.queue, func.count(), func.min(outbox.c.created))
    waiting = dict.fromkeys(QUEUES, Waiting(0, 0.0)) | {
        queue: Waiting(count, max(unit.now - first, 0.0))
        for queue, count, first in unit.execute(queues.group_by(outbox.c.queue))
    }
    held = block.c.state == BlockState.running
    running = unit.execute(select(func.count()).select_from(block).where(held)).scalar_one()
    late = select(func.count()).select_from(block).where(held, block.c.lease_until < unit.now)
    return Census(
        jobs,
        waiting,
        running,
        unit.execute(late).scalar_one(),
        count_unserved(unit),
        on_the_way(unit),
        devices(unit),
        tally.totals(unit),
    )
