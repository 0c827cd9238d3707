"""Accepting jobs and cancelling them: what users ask for."""

from collections.abc import Callable, Hashable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

from sqlalchemy import (
    ColumnElement,
    Connection,
    Row,
    and_,
    bindparam,
    delete,
    exists,
    func,
    insert,
    select,
    update,
)

from jointplay.storage.catalogue import tables
from jointplay.storage.catalogue.errors import KeyReused
from jointplay.storage.catalogue.records import (
    BlockState,
    Job,
    JobState,
    NewJob,
    SubmissionKey,
    Submitted,
)
from jointplay.storage.catalogue.rows import find_job, job_record, lock_job, step_job

FRESH_QUEUE = "jobs"
_LONGEST_NAME = 200  # of a scene, as it is looked for
_REUSED = (JobState.queued.value, JobState.running.value, JobState.succeeded.value)
_UNSET = dict.fromkeys(column.name for column in tables.job.columns)
_LIVE = (BlockState.queued.value, BlockState.running.value)


@dataclass(frozen=True)
class Request:
    """A job that is asked for, and what an earlier one may be found by."""

    new: NewJob
    key: SubmissionKey | None
    reuse: bool

    def names(self) -> set[Hashable]:
        """Return what later requests may find its job by."""
        computes = ("computes", self.new.digest)
        return {computes} if self.key is None else {computes, ("key", self.key.key)}


def submit(
    connection: Connection, requests: Sequence[Request], next_id: Callable[[], str], now: float
) -> list[Submitted | KeyReused]:
    """Store jobs, their blocks and their wake-ups, or find the jobs that earlier requests made.

    The requests are answered as if one came after the other; new jobs are stored together.
    """
    answers: list[Submitted | KeyReused] = []
    fresh: list[tuple[str, Request]] = []
    pending: set[Hashable] = set()
    for request in requests:
        names = request.names()
        if names & pending:
            _store(connection, fresh, now)
            fresh, pending = [], set()
        try:
            answer = _earlier(connection, request, now)
        except KeyReused as error:
            answers.append(error)
            continue
        if answer is None:
            job_id = next_id()
            fresh.append((job_id, request))
            pending |= names
            row = _job_row(job_id, request.new, now)
            answer = Submitted(job_record({**_UNSET, **row}), created=True)
        answers.append(answer)
    _store(connection, fresh, now)
    return answers


def _earlier(connection: Connection, request: Request, now: float) -> Submitted | None:
    """Find the job of an earlier request with the same key, or one that computes the same."""
    key, new = request.key, request.new
    if key is not None:
        earlier = earlier_answer(connection, key, now)
        if earlier is not None and earlier.job is not None:
            job = find_job(connection, earlier.job)
            # a key is stored with the job that it made, and later than one that it found
            return Submitted(job, created=False, cached=earlier.created > job.created)
    same = same_job(connection, new, now) if request.reuse else None
    if same is None:
        return None
    if key is not None:
        remember_key(connection, key, now, job=same)
    job = find_job(connection, same)
    if job.expires is not None and (new.expires is None or new.expires > job.expires):
        keep = update(tables.job).where(tables.job.c.id == same).values(expires=new.expires)
        connection.execute(keep)
        job = replace(job, expires=new.expires)
    return Submitted(job, created=False, cached=True)


def _store(connection: Connection, fresh: Sequence[tuple[str, Request]], now: float) -> None:
    if not fresh:
        return
    insert_jobs(connection, [(job_id, request.new) for job_id, request in fresh], now)
    for job_id, request in fresh:
        if request.key is not None:
            remember_key(connection, request.key, now, job=job_id)


_SAME_JOB = (
    select(tables.job.c.id)
    .where(
        tables.job.c.digest == bindparam("digest"),
        tables.job.c.solver_version == bindparam("solver_version"),
        tables.job.c.kind == bindparam("kind"),
        tables.job.c.owner == bindparam("owner"),
        tables.job.c.state.in_(_REUSED),
        tables.job.c.expires.is_(None) | (tables.job.c.expires > bindparam("now")),
    )
    .order_by(tables.job.c.id.desc())
    .limit(1)
)


def same_job(connection: Connection, new: NewJob, now: float) -> str | None:
    """Return the newest job that asks this solver for the same, unless it ended badly or expired.

    The digest covers the filled-in job without its label, the version the solver's sources.
    """
    asked = {
        "digest": new.digest,
        "solver_version": new.solver_version,
        "kind": new.kind,
        "owner": new.owner,
        "now": now,
    }
    return connection.execute(_SAME_JOB, asked).scalar_one_or_none()


def insert_jobs(connection: Connection, jobs: Sequence[tuple[str, NewJob]], now: float) -> None:
    """Store new jobs with their ids, all their blocks, wake-ups and first events."""
    connection.execute(insert(tables.job), [_job_row(job_id, new, now) for job_id, new in jobs])
    blocks = [row for job_id, new in jobs for row in _block_rows(job_id, new)]
    connection.execute(insert(tables.block), blocks)
    connection.execute(
        insert(tables.outbox),
        [
            {"block": block["id"], "queue": FRESH_QUEUE, "created": now, "due": now, "tries": 0}
            for block in blocks
            if block["state"] == BlockState.queued.value
        ],
    )
    connection.execute(
        insert(tables.event),
        [
            {"job": job_id, "seq": 1, "time": now, "type": JobState.queued.value, "data": {}}
            for job_id, _ in jobs
        ],
    )


def _job_row(job_id: str, new: NewJob, now: float) -> dict[str, Any]:
    return {
        "id": job_id,
        "kind": new.kind,
        "owner": new.owner,
        "label": new.label,
        "batch": new.batch,
        "scene": None if new.scene is None else new.scene[:_LONGEST_NAME],
        "spec": new.spec,
        "digest": new.digest,
        "solver_version": new.solver_version,
        "result_schema": new.result_schema,
        "state": JobState.queued.value,
        "progress_time": 0.0,
        "progress_fraction": 0.0,
        "attempt": 0,
        "created": now,
        "expires": new.expires,
    }


def _block_rows(job_id: str, new: NewJob) -> Iterator[dict[str, Any]]:
    cuts = [(first, count, BlockState.queued) for first, count in new.blocks]
    if new.seal:
        first, count = new.blocks[-1]
        cuts.append((first + count, 0, BlockState.waiting))
    for index, (first, count, state) in enumerate(cuts):
        yield {
            "id": f"{job_id}-{index}",
            "job": job_id,
            "index": index,
            "first": first,
            "count": count,
            "state": state.value,
            "attempt": 0,
            "losses": 0,
            "watermark": 0,
            "progress_time": 0.0,
            "progress_fraction": 0.0,
        }


def earlier_answer(connection: Connection, key: SubmissionKey, now: float) -> Row[Any] | None:
    """Find what a key was answered with (its job or batch), if it is still remembered.

    Raises
    ------
    KeyReused
        It was used for another request.
    """
    table = tables.idempotency
    same_key = and_(table.c.owner == key.owner, table.c.key == key.key)
    row = connection.execute(select(table).where(same_key)).one_or_none()
    if row is None:
        return None
    if row.expires <= now or (row.job is None and row.batch is None):
        connection.execute(delete(table).where(same_key))
        return None
    if row.fingerprint != key.fingerprint:
        raise KeyReused(key.key)
    return row


def remember_key(
    connection: Connection,
    key: SubmissionKey,
    now: float,
    *,
    job: str | None = None,
    batch: str | None = None,
) -> None:
    """Have a key find this job or batch while it is remembered."""
    connection.execute(
        insert(tables.idempotency).values(
            owner=key.owner,
            key=key.key,
            fingerprint=key.fingerprint,
            job=job,
            batch=batch,
            created=now,
            expires=now + key.seconds,
        )
    )


def request_cancel(connection: Connection, job_id: str, now: float) -> Job:
    """Cancel what has not started at once, and ask workers to stop what they hold.

    A block that a lost worker left behind has results; it stays queued, so that a worker closes
    its store properly.
    """
    job = lock_job(connection, job_id)
    if job.state.terminal or job.state is JobState.cancelling:
        return job
    block = tables.block
    drop_queued_blocks(connection, job_id, untouched=True)
    live = connection.execute(
        select(func.count()).where(block.c.job == job_id, block.c.state.in_(_LIVE))
    ).scalar_one()
    if job.state is JobState.running:
        step_job(connection, job_id, JobState.cancelling, now)
    if not live:
        step_job(connection, job_id, JobState.cancelled, now)
    return find_job(connection, job_id)


def drop_queued_blocks(connection: Connection, job_id: str, *, untouched: bool) -> None:
    """Cancel a job's blocks that nobody holds, or that nobody ever held; forget their wake-ups."""
    drop_blocks(connection, tables.block.c.job == job_id, untouched=untouched)


def drop_blocks(connection: Connection, of: ColumnElement[bool], *, untouched: bool) -> None:
    """Cancel those blocks among some that nobody holds, or that nobody ever held."""
    block, outbox = tables.block, tables.outbox
    dropped = and_(of, block.c.state.in_((BlockState.queued.value, BlockState.waiting.value)))
    if untouched:
        dropped = and_(dropped, block.c.attempt == 0)
    connection.execute(
        delete(outbox).where(exists().where(and_(block.c.id == outbox.c.block, dropped)))
    )
    connection.execute(update(block).where(dropped).values(state=BlockState.cancelled.value))
