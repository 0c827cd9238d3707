"""Core seconds that owners have used, of each hour, kept for a day.

They are the time that workers, each of one core, held blocks of an owner: computing, compiling,
reading and writing.

They are counted when an attempt at a block ends, however it does, by owner and worker: so no two
units wait for each other. What runs is added when it is asked for.
"""

from typing import Final

from sqlalchemy import and_, delete, exists, func, select, text, update

from jointplay.storage.catalogue import tables
from jointplay.storage.catalogue.connections import Unit
from jointplay.storage.catalogue.records import BlockState

_HOUR: Final = 3600.0  # s
_DAY: Final = 24  # hours
_usage = tables.usage
_ADD: Final = text(
    "INSERT INTO usage (owner, hour, worker, seconds) VALUES (:owner, :hour, :worker, :seconds)"
    " ON CONFLICT (owner, hour, worker) DO UPDATE SET seconds = usage.seconds + excluded.seconds"
)


def add(unit: Unit, owner: str, worker: str, seconds: float) -> None:
    """Count core seconds that an attempt of this worker took."""
    hour = int(unit.now // _HOUR)
    unit.execute(_ADD, {"owner": owner, "hour": hour, "worker": worker, "seconds": seconds})


def pass_over(unit: Unit, seconds: float, before: float) -> None:
    """Have attempts that began before a moment, and go on, be so many seconds shorter.

    By so much the clock was set forward since then, or so long the machine slept: nobody computed.
    """
    block, attempt = tables.block, tables.attempt
    of_block = (attempt.c.block == block.c.id) & (attempt.c.number == block.c.attempt)
    goes_on = exists().where(of_block, block.c.state == BlockState.running)
    began = (attempt.c.ended.is_(None)) & (attempt.c.started <= before)
    later = {"started": attempt.c.started + seconds}
    unit.execute(update(attempt).where(began, goes_on).values(later))


def core_seconds_of(unit: Unit, owner: str) -> float:
    """Return the core seconds of an owner's attempts in the last 24 hours, by the hour."""
    lately = _usage.c.hour > unit.now // _HOUR - _DAY
    ended = select(func.sum(_usage.c.seconds)).where(_usage.c.owner == owner, lately)
    block, attempt, job = tables.block, tables.attempt, tables.job
    runs = (
        select(func.sum(unit.now - attempt.c.started))
        .select_from(block)
        .join(attempt, and_(attempt.c.block == block.c.id, attempt.c.number == block.c.attempt))
        .join(job, job.c.id == block.c.job)
        .where(block.c.state == BlockState.running, job.c.owner == owner)
    )
    return sum(float(unit.execute(part).scalar_one() or 0.0) for part in (ended, runs))


def forget(unit: Unit) -> None:
    """Forget the hours that count no longer."""
    unit.execute(delete(_usage).where(_usage.c.hour <= unit.now // _HOUR - _DAY))
