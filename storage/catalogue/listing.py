"""Reading jobs: pages by key, histories, and what changes while they are computed."""

from collections.abc import Sequence
from dataclasses import fields
from typing import Any, Final

from sqlalchemy import Text, cast, func, or_, select

from jointplay.storage.catalogue import tables
from jointplay.storage.catalogue.connections import Unit
from jointplay.storage.catalogue.identifiers import earliest
from jointplay.storage.catalogue.labels import is_label, labelled
from jointplay.storage.catalogue.quotas import running_of
from jointplay.storage.catalogue.records import (
    TERMINAL,
    Attempt,
    Block,
    BlockState,
    Event,
    Job,
    JobFilter,
    JobPage,
    JobStatus,
)

LARGEST_PAGE = 1000
LONGEST_PAGE: Final = 2**23
"""Characters of the documents of a page's jobs; a single job may have more."""


def page_of_jobs(
    unit: Unit,
    /,
    *,
    limit: int = 50,
    after: str | None = None,
    oldest_first: bool = False,
    **filtered: Any,
) -> JobPage:
    """Return one page of jobs, newest first; `after` is the `next` of the page before.

    `oldest_first` turns it round: the jobs of a batch then come as they were submitted. The other
    arguments are fields of `JobFilter`. Expired jobs are left out; pages do not shift when jobs
    arrive. A page ends early where its documents are long: see `LONGEST_PAGE`.

    Raises
    ------
    ValueError
        The limit is not between 1 and 1000.
    """
    wanted = JobFilter(**filtered)
    if not 1 <= limit <= LARGEST_PAGE:
        raise ValueError(f"a page has 1 to {LARGEST_PAGE} jobs, not {limit}")
    columns = tables.job.c
    order = columns.id.asc() if oldest_first else columns.id.desc()
    statement = select(tables.job).order_by(order).limit(limit + 1)
    if after is not None:
        statement = statement.where(columns.id > after if oldest_first else columns.id < after)
    if wanted.label is not None:
        statement = statement.where(is_label(wanted.label))
    for name in ("state", "kind", "scene", "batch", "owner"):
        value = getattr(wanted, name)
        if value is not None:
            statement = statement.where(columns[name] == value)
    # an id begins with its time: the primary key finds a window of time at once
    if wanted.since is not None:
        statement = statement.where(columns.id >= earliest(wanted.since))
    if wanted.before is not None:
        statement = statement.where(columns.id < earliest(wanted.before))
    live = columns.state.not_in(TERMINAL)
    statement = statement.where(live | tables.unexpired(unit.now))
    sizes = statement.with_only_columns(columns.id, func.length(cast(columns.spec, Text)))
    listed = [(job_id, size) for job_id, size in unit.execute(sizes)]
    count = min(_fitting([size for _, size in listed]), limit)
    page = [job_id for job_id, _ in listed[:count]]
    found = [Job(**row._mapping) for row in unit.execute(statement.where(columns.id.in_(page)))]
    more = len(listed) > count
    return JobPage(tuple(labelled(unit, found)), page[-1] if more else None)


def _fitting(sizes: Sequence[int]) -> int:
    """Return how many of the first documents, of so many characters each, fit a page."""
    total = 0
    for count, size in enumerate(sizes):
        total += size
        if count and total > LONGEST_PAGE:
            return count
    return len(sizes)


def blocks_of(unit: Unit, job_id: str) -> tuple[Block, ...]:
    """Return a job's blocks by index."""
    table = tables.block
    rows = unit.execute(select(table).where(table.c.job == job_id).order_by(table.c.index))
    return tuple(Block(**row._mapping) for row in rows)


def queued_of(unit: Unit, job_id: str, most: int, most_running: int = 0) -> tuple[str, ...]:
    """Return at most so many of a study's queued blocks of points that may be claimed, by index.

    With them no more than `most_running` blocks of the job's owner are computed; 0: any number.
    """
    table, outbox = tables.block, tables.outbox
    owner = unit.execute(select(tables.job.c.owner).where(tables.job.c.id == job_id)).scalar()
    if most_running and owner:
        most = min(most, most_running - running_of(unit, owner))
    waits = (table.c.job == job_id) & (table.c.state == BlockState.queued) & (table.c.count > 0)
    due = or_(outbox.c.due <= unit.now, outbox.c.tries > 0)  # otherwise it was put off
    found = select(table.c.id).join(outbox, outbox.c.block == table.c.id).where(waits, due)
    return tuple(unit.execute(found.order_by(table.c.index).limit(max(most, 0))).scalars())


def held_by(unit: Unit, worker: str) -> tuple[Block, ...]:
    """Return the blocks that a worker holds."""
    table = tables.block
    held = (table.c.state == BlockState.running) & (table.c.worker == worker)
    return tuple(Block(**row._mapping) for row in unit.execute(select(table).where(held)))


def attempts_of(unit: Unit, job_id: str) -> tuple[Attempt, ...]:
    """Return every attempt at a job's blocks, by block index and number."""
    table, block = tables.attempt, tables.block
    rows = unit.execute(
        select(*(table.c[field.name] for field in fields(Attempt)))
        .join(block, block.c.id == table.c.block)
        .where(block.c.job == job_id)
        .order_by(block.c.index, table.c.number)
    )
    return tuple(Attempt(**row._mapping) for row in rows)


def events_of(unit: Unit, job_id: str, *, after: int = 0, limit: int = 1000) -> tuple[Event, ...]:
    """Return what happened to a job after event number `after`, in order."""
    table = tables.event
    rows = unit.execute(
        select(table)
        .where(table.c.job == job_id, table.c.seq > after)
        .order_by(table.c.seq)
        .limit(limit)
    )
    return tuple(Event(**row._mapping) for row in rows)


def statuses_of(unit: Unit, jobs: Sequence[str]) -> tuple[JobStatus, ...]:
    """Return what changes while jobs are computed, of those among them that there are."""
    columns, event = tables.job.c, tables.event
    newest = select(func.max(event.c.seq)).where(event.c.job == columns.id).scalar_subquery()
    rows = unit.execute(
        select(
            columns.id,
            columns.state,
            columns.activity,
            columns.attempt,
            columns.progress_time,
            columns.progress_fraction,
            columns.steps,
            newest,
        ).where(columns.id.in_(jobs))
    )
    return tuple(JobStatus(*row) for row in rows)


def newest_event(unit: Unit) -> float | None:
    """Return when the newest of all events happened (epoch seconds)."""
    found: float | None = unit.execute(select(func.max(tables.event.c.time))).scalar_one()
    return found


def known_blocks(unit: Unit, blocks: Sequence[str]) -> frozenset[str]:
    """Return those ids of blocks that there are."""
    known = select(tables.block.c.id).where(tables.block.c.id.in_(blocks))
    return frozenset(unit.execute(known).scalars())
