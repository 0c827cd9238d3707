"""Reading jobs: pages by key, histories, and jobs that were computed before."""

from sqlalchemy import Connection, select

from storage.catalogue import tables
from storage.catalogue.records import Attempt, Block, Event, Job, JobPage, JobState
from storage.catalogue.rows import attempt_record, block_record, event_record, job_record

LARGEST_PAGE = 1000


def page_of_jobs(
    connection: Connection,
    *,
    limit: int,
    after: str | None,
    state: JobState | None,
    kind: str | None,
    label: str | None,
    owner: str | None,
    batch: str | None,
    oldest_first: bool,
) -> JobPage:
    """Return jobs beyond `after`, newest or oldest first; pages do not shift when jobs arrive."""
    if not 1 <= limit <= LARGEST_PAGE:
        raise ValueError(f"a page has 1 to {LARGEST_PAGE} jobs, not {limit}")
    columns = tables.job.c
    order = columns.id.asc() if oldest_first else columns.id.desc()
    statement = select(tables.job).order_by(order).limit(limit + 1)
    if after is not None:
        statement = statement.where(columns.id > after if oldest_first else columns.id < after)
    for column, wanted in (
        (columns.state, state.value if state else None),
        (columns.kind, kind),
        (columns.label, label),
        (columns.owner, owner),
        (columns.batch, batch),
    ):
        if wanted is not None:
            statement = statement.where(column == wanted)
    found = [job_record(row) for row in connection.execute(statement)]
    more = len(found) > limit
    jobs = tuple(found[:limit])
    return JobPage(jobs, jobs[-1].id if more else None)


def blocks_of(connection: Connection, job_id: str) -> tuple[Block, ...]:
    """Return a job's blocks by index."""
    table = tables.block
    rows = connection.execute(select(table).where(table.c.job == job_id).order_by(table.c.index))
    return tuple(block_record(row) for row in rows)


def attempts_of(connection: Connection, job_id: str) -> tuple[Attempt, ...]:
    """Return every attempt at a job's blocks, by block index and number."""
    table, block = tables.attempt, tables.block
    rows = connection.execute(
        select(table)
        .join(block, block.c.id == table.c.block)
        .where(block.c.job == job_id)
        .order_by(block.c.index, table.c.number)
    )
    return tuple(attempt_record(row) for row in rows)


def events_of(connection: Connection, job_id: str, *, after: int, limit: int) -> tuple[Event, ...]:
    """Return what happened to a job after event number `after`, in order."""
    table = tables.event
    rows = connection.execute(
        select(table)
        .where(table.c.job == job_id, table.c.seq > after)
        .order_by(table.c.seq)
        .limit(limit)
    )
    return tuple(event_record(row) for row in rows)


def same_digest(connection: Connection, digest: str, owner: str, now: float) -> Job | None:
    """Return the newest succeeded job of this owner with this digest that has not expired."""
    columns = tables.job.c
    row = connection.execute(
        select(tables.job)
        .where(
            columns.digest == digest,
            columns.owner == owner,
            columns.state == JobState.succeeded.value,
            (columns.expires.is_(None)) | (columns.expires > now),
        )
        .order_by(columns.id.desc())
        .limit(1)
    ).one_or_none()
    return job_record(row) if row else None
