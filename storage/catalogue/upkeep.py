"""Queries of relay and reaper: unannounced blocks, lost leases, expired jobs, the leader.

A job that expires can be read no more; its results are removed soon, and its row says that they
were.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import inf
from operator import attrgetter
from typing import Any

from sqlalchemy import ColumnElement, case, delete, func, insert, select, true, update

from jointplay.storage.catalogue import quotas, tables, usage
from jointplay.storage.catalogue.connections import Unit
from jointplay.storage.catalogue.ending import LONGEST_PAUSE, lose
from jointplay.storage.catalogue.errors import JobNotFinished
from jointplay.storage.catalogue.labels import labelled_job
from jointplay.storage.catalogue.records import NOT_REPRODUCED, QUEUES, TERMINAL, BlockState, Job
from jointplay.storage.catalogue.rows import lock_job

_job = tables.job
_REAP_AT_ONCE = 200
_APART = 1.0  # s; processes know the time as well as that
_RAREST_REPEAT = 16  # a wake-up is repeated after at most this many times `republish_after`


@dataclass(frozen=True)
class WakeUp:
    """A queued block for which a worker has to be woken, and on which Celery queue."""

    block: str
    queue: str


@dataclass(frozen=True)
class Reaped:
    """Result of reaping: blocks queued again, and jobs it ended."""

    requeued: tuple[str, ...]
    ended: tuple[str, ...]


def due_wake_ups(unit: Unit, outstanding: int, most_running: int = 0) -> tuple[WakeUp, ...]:
    """Return what to publish now: due wake-ups, recovered blocks first.

    Any owner's: whoever is woken takes the block whose turn it is.

    At most `outstanding` may be on their way at one time: what Redis holds stays small however many
    blocks wait, and losing it costs little. Owners of whose blocks `most_running` are computed are
    passed by; 0: any number may be.
    """
    outbox = tables.outbox
    underway = on_the_way(unit)
    busy = quotas.busy_owners(unit, most_running)
    idle = outbox.c.owner.not_in(busy) if busy else true()
    due: list[WakeUp] = []
    for queue in QUEUES:  # by index: the cost is that of the answer
        rows = unit.execute(
            select(outbox.c.block)
            .where(outbox.c.queue == queue, outbox.c.due <= unit.now, idle)
            .order_by(outbox.c.owner, outbox.c.block)
            .limit(max(outstanding - underway - len(due), 0))
        )
        due += [WakeUp(block, queue) for block in rows.scalars()]
    return tuple(due)


def on_the_way(unit: Unit) -> int:
    """Count the wake-ups that were sent and not yet answered by a claim."""
    sent = select(func.count()).select_from(tables.outbox).where(_sent(unit))
    return int(unit.execute(sent).scalar_one())


def _sent(unit: Unit) -> ColumnElement[bool]:
    return (tables.outbox.c.due > unit.now) & (tables.outbox.c.tries > 0)


def mark_published(
    unit: Unit, blocks: tuple[str, ...], republish_after: float, *, seen: float = inf
) -> None:
    """Record that workers were woken; a block still unclaimed later is due again.

    One that has become due since it was `seen` [epoch s] is due still: a worker that was quicker
    than this record took another block, and has this one announced again.
    """
    outbox = tables.outbox
    patience = case((outbox.c.tries < _RAREST_REPEAT, outbox.c.tries + 1), else_=_RAREST_REPEAT)
    unit.execute(
        update(outbox)
        .where(outbox.c.block.in_(blocks), outbox.c.due <= seen)
        .values(tries=outbox.c.tries + 1, due=unit.now + republish_after * patience)
    )


def announce_again(unit: Unit) -> int:
    """Make every wake-up that was sent due again, because it was lost. Returns their number."""
    again = update(tables.outbox).where(_sent(unit)).values(due=unit.now)
    return int(unit.execute(again).rowcount)


def too_far_ahead(
    unit: Unit, lease: float, republish_after: float
) -> tuple[ColumnElement[bool], ColumnElement[bool]]:
    """Return which blocks are held, and which wake-ups are put off, for longer than can be."""
    block, outbox = tables.block, tables.outbox
    held = (block.c.state == BlockState.running.value) & (
        block.c.lease_until > unit.now + 2 * lease
    )
    longest = 2 * _RAREST_REPEAT * republish_after + LONGEST_PAUSE
    late = (outbox.c.due > unit.now + longest) | (outbox.c.created > unit.now + _APART)
    return held, late


def mend_after_setting_back(unit: Unit, lease: float, republish_after: float) -> None:
    """Shorten what waits longer than can be, because the clock was set back: leases, wake-ups."""
    held, late = too_far_ahead(unit, lease, republish_after)
    unit.execute(update(tables.block).where(held).values(lease_until=unit.now + lease))
    unit.execute(update(tables.outbox).where(late).values(created=unit.now, due=unit.now))


def holders(unit: Unit) -> tuple[str, ...]:
    """Return the workers that hold blocks."""
    block = tables.block
    held = select(block.c.worker).where(block.c.state == BlockState.running).distinct()
    return tuple(unit.execute(held).scalars())


def reap(unit: Unit, max_attempts: int, ended: Sequence[str] = (), *, until: float = inf) -> Reaped:
    """Take back the blocks whose lease ran out, or whose worker is one of those that have ended.

    A lease that runs out after the time `until` [epoch s] is left, whatever the time is: the clock
    may have been set. Idempotency keys and core seconds past their time are forgotten.
    """
    block = tables.block
    lost = (block.c.lease_until < min(unit.now, until)) | block.c.worker.in_(ended)
    found = unit.execute(
        select(block.c.id, block.c.attempt, block.c.job)
        .where(block.c.state == BlockState.running, lost)
        .order_by(block.c.lease_until, block.c.id)
        .limit(_REAP_AT_ONCE)
    ).all()
    requeued, given_up = [], []
    for row, outcome in take_back(unit, found, lost, max_attempts):
        if outcome is BlockState.queued:
            requeued.append(row.id)
        else:
            given_up.append(row.job)
    unit.execute(delete(tables.idempotency).where(tables.idempotency.c.expires <= unit.now))
    usage.forget(unit)
    return Reaped(tuple(requeued), tuple(given_up))


def take_back(
    unit: Unit, found: Sequence[Any], lost: ColumnElement[bool], max_attempts: int
) -> Iterator[tuple[Any, BlockState]]:
    """Take back blocks that are still `lost` once they are locked; give each, and its state.

    `found` : rows with their id, attempt and job.
    """
    block = tables.block
    for row in sorted(found, key=attrgetter("job")):  # locked in the order that all others have
        lock_job(unit, row.job)
        same = (block.c.id == row.id) & (block.c.attempt == row.attempt)
        still = select(block.c.id).where(same, block.c.state == BlockState.running, lost)
        if unit.execute(still.with_for_update()).one_or_none() is None:
            continue  # its worker was heard of meanwhile
        yield row, lose(unit, row.id, row.attempt, max_attempts)


def expire(unit: Unit, job_id: str) -> Job:
    """Let a finished job expire now, unless it did before; its results are removed soon.

    Raises
    ------
    JobNotFound
    JobNotFinished
        It is queued, running or cancelling: it has to be cancelled first.
    """
    job = lock_job(unit, job_id)
    if not job.state.terminal:
        raise JobNotFinished(job_id, job.state.value)
    if not job.expired(unit.now):
        gone = {"expires": unit.now, "deleted": unit.now}
        unit.execute(update(_job).where(_job.c.id == job_id).values(gone))
    return labelled_job(unit, job_id)


def removable(unit: Unit, limit: int) -> tuple[str, ...]:
    """Return jobs whose results are to go and are still there: what was deleted, what expired.

    What expired first comes first. What was deleted goes whatever the clock says.
    """
    deleted = select(_job.c.id).where(tables.TO_REMOVE).order_by(_job.c.id).limit(limit)
    expired = (
        select(_job.c.id)
        .where(_job.c.removed.is_(None), _job.c.expires <= unit.now, _job.c.state.in_(TERMINAL))
        .order_by(_job.c.expires)
        .limit(limit)
    )
    found = [*unit.execute(deleted).scalars(), *unit.execute(expired).scalars()]
    return tuple(dict.fromkeys(found))[:limit]


def give_up(unit: Unit, jobs: Sequence[str]) -> tuple[str, ...]:
    """Delete those among jobs that have expired, and return them, before their results go.

    A request for the same may have found one meanwhile, which is kept longer since then.
    """
    if unit.shared:  # in the order that all others have
        wanted = select(_job.c.id).where(_job.c.id.in_(jobs)).order_by(_job.c.id)
        unit.execute(wanted.with_for_update(key_share=True)).all()
    due = _job.c.deleted.is_not(None) | (_job.c.expires <= unit.now)
    still = _job.c.id.in_(jobs) & _job.c.removed.is_(None) & _job.c.state.in_(TERMINAL) & due
    gone = update(_job).where(still).values(deleted=func.coalesce(_job.c.deleted, unit.now))
    found = set(unit.execute(gone.returning(_job.c.id)).scalars())
    return tuple(job for job in jobs if job in found)


def mark_removed(unit: Unit, jobs: Sequence[str]) -> None:
    """Remember that the results of jobs are gone."""
    unit.execute(update(_job).where(_job.c.id.in_(jobs)).values(removed=unit.now, stored=0))


def mark_damaged(unit: Unit, job: str, damage: str | None) -> None:
    """Remember which file of a finished job's results is damaged; none: they are whole again.

    That they are `NOT_REPRODUCED` stays, whatever their files are.
    """
    finished = (_job.c.id == job) & _job.c.state.in_(TERMINAL)
    of_files = _job.c.damaged.is_distinct_from(NOT_REPRODUCED)
    unit.execute(update(_job).where(finished, of_files).values(damaged=damage))


def mark_not_reproduced(unit: Unit, job_id: str) -> Job:
    """Remember that a repetition of a finished job gave other results: it is found no more.

    Raises
    ------
    JobNotFound
    JobNotFinished
        It is queued, running or cancelling.
    """
    job = lock_job(unit, job_id)
    if not job.state.terminal:
        raise JobNotFinished(job_id, job.state.value)
    unit.execute(update(_job).where(_job.c.id == job_id).values(damaged=NOT_REPRODUCED))
    return labelled_job(unit, job_id)


def take_lead(unit: Unit, name: str, holder: str, seconds: float) -> bool:
    """Take or keep the lead of a task for `seconds`; false while another process has it."""
    leader = tables.leader
    lead = {"holder": holder, "until": unit.now + seconds}
    over = (leader.c.until <= unit.now) | (
        leader.c.until > unit.now + 2 * seconds
    )  # clock set back
    free = (leader.c.holder == holder) | over
    taken = unit.execute(update(leader).where(leader.c.name == name, free).values(lead))
    if taken.rowcount == 1:
        return True
    if unit.execute(select(leader.c.name).where(leader.c.name == name)).one_or_none() is None:
        unit.execute(insert(leader).values(name=name, **lead))  # there was no leader
        return True
    return False


def leader(unit: Unit, name: str) -> str | None:
    """Return who had the lead of a task last, if anybody had."""
    holder = select(tables.leader.c.holder).where(tables.leader.c.name == name)
    found = unit.execute(holder).scalar_one_or_none()
    return None if found is None else str(found)


def release_lead(unit: Unit, name: str, holder: str) -> None:
    """Give the lead up, so that another process can take it at once."""
    leader = tables.leader
    held = update(leader).where(leader.c.name == name, leader.c.holder == holder)
    unit.execute(held.values(until=unit.now))
