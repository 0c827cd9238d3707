"""Accepting jobs and cancelling them: what users ask for."""

from collections.abc import Callable, Hashable, Iterator, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from typing import Any

from sqlalchemy import (
    ColumnElement,
    and_,
    bindparam,
    delete,
    func,
    insert,
    select,
    update,
)

from jointplay.storage.catalogue import fair_queueing, idempotency, labels, retries, tables
from jointplay.storage.catalogue.connections import Unit
from jointplay.storage.catalogue.databases.postgresql import lock_numbers
from jointplay.storage.catalogue.errors import CatalogueError, KeyReused, QuotaExceeded
from jointplay.storage.catalogue.numbers import number_of
from jointplay.storage.catalogue.quotas import Quota, Uses
from jointplay.storage.catalogue.records import (
    FRESH_QUEUE,
    INTERACTIVE_QUEUE,
    LIVE,
    Block,
    BlockState,
    Job,
    JobRequest,
    JobState,
    NewJob,
    SubmissionKey,
    Submitted,
)
from jointplay.storage.catalogue.rows import find_job, lock_job, step_job

_LONGEST_NAME = 200  # of a scene, as it is looked for
_REUSED = (JobState.queued, JobState.running, JobState.succeeded)
_LIVE = (BlockState.queued, BlockState.running)
_OF_REQUEST = [field.name for field in fields(JobRequest)]
# each value that a column begins with; the fields without one are always given
_NEW_JOB = {field.name: field.default for field in fields(Job) if field.default is not None}
_NEW_BLOCK = {field.name: field.default for field in fields(Block) if field.default is not None}

Row = dict[str, Any]
"""Values by column."""


@dataclass(frozen=True)
class Request:
    """A job that is asked for, and what an earlier one may be found by."""

    new: NewJob
    key: SubmissionKey | None
    reuse: bool
    quota: Quota
    """Limits of the key that asks for it: an administrator of the same owner has none."""

    def names(self) -> set[Hashable]:
        """Return what later requests may find its job by."""
        computes = ("computes", self.new.digest)
        return {computes} if self.key is None else {computes, ("key", self.key.stored)}


def submit(
    unit: Unit,
    requests: Sequence[Request],
    next_id: Callable[[], str],
    clock: Callable[[], float],
) -> list[Submitted | CatalogueError]:
    """Store jobs, their blocks and their wake-ups, or find the jobs that earlier requests made.

    The requests are answered as if one came after the other; new jobs are stored together. The unit
    may have waited for others since its moment: the clock tells what these did meanwhile.
    """
    looked_for = [one.new.number for one in requests if one.reuse]
    looked_for += [one.key.number for one in requests if one.key is not None]
    owners = {one.new.owner for one in requests} - {""}
    looked_for += [number_of("turn", owner) for owner in owners]  # in one order
    lock_numbers(unit.connection, *looked_for)
    uses = Uses(unit, {one.new.owner for one in requests if one.quota})
    answers: list[Submitted | CatalogueError] = []
    fresh: list[tuple[Row, Request]] = []
    pending: set[Hashable] = set()
    seen: set[Hashable] = set()
    found = _look_up(unit, requests)
    for request in requests:
        names = request.names()
        if names & pending:
            _store(unit, fresh)
            fresh, pending = [], set()
        if names & seen:  # what was found then may have changed
            found |= _look_up(unit, [request])
        seen |= names
        try:
            answer = _earlier(unit, request, found, clock)
            if answer is None:
                uses.add(request.new.owner, 1, request.quota)
        except (KeyReused, QuotaExceeded) as error:
            answers.append(error)
            continue
        if answer is None:
            row = row_of(next_id(), request.new, unit.now)
            fresh.append((row, request))
            pending |= names
            answer = Submitted(Job(**row), created=True)
        answers.append(answer)
    _store(unit, fresh)
    return answers


def _look_up(unit: Unit, requests: Sequence[Request]) -> dict[Hashable, Any]:
    """Find, by keys, rows of what they were answered with, and by what is computed, jobs' ids.

    All of them in two statements; what is not found is None.
    """
    keys = [one.key.stored for one in requests if one.key is not None]
    same = [one.new for one in requests if one.reuse]
    found: dict[Hashable, Any] = dict.fromkeys([*keys, *(_computed(one) for one in same)])
    if keys:
        found |= idempotency.answers(unit, keys)
    if same:
        asked = {"digests": [one.digest for one in same], "now": unit.now}
        for *computed, newest in unit.execute(_SAME_JOBS, asked):
            found[tuple(computed)] = newest
    return found


def _computed(new: NewJob) -> Hashable:
    return new.digest, new.solver_version, new.kind, new.owner


def _earlier(
    unit: Unit, request: Request, found: Mapping[Hashable, Any], clock: Callable[[], float]
) -> Submitted | None:
    """Return the job of an earlier request with the same key, or one that computes the same."""
    key, new = request.key, request.new
    if key is not None:
        earlier = idempotency.still_counting(unit, key, found[key.stored])
        if earlier is not None and earlier.job is not None:
            return idempotency.submitted_before(unit, earlier)
    same = found[_computed(new)] if request.reuse else None
    if same is None:
        return None
    job = find_job(unit, same)
    if job.expires is not None and (new.expires is None or new.expires > job.expires):
        if lock_job(unit, same).expired(clock()):  # it was deleted, which stays so
            return None
        job = replace(job, expires=new.expires, kept_for=_longer(job.lifetime, new, unit.now))
        keep = {"expires": job.expires, "kept_for": job.kept_for}
        unit.execute(update(tables.job).where(tables.job.c.id == same).values(keep))
    if key is not None:
        idempotency.remember(unit, [(key, same)])
    if job.label is None and new.label is not None:
        unit.execute(update(tables.job).where(tables.job.c.id == same).values(label=new.label))
        job = replace(job, label=new.label)
    elif new.label is not None:
        labels.add(unit, job, new.label)
    if new.retry_of is not None:
        retries.record_once(unit, new.retry_of, same)
    (job,) = labels.labelled(unit, [job])
    return Submitted(job, created=False, cached=True)


def _store(unit: Unit, fresh: Sequence[tuple[Row, Request]]) -> None:
    if not fresh:
        return
    insert_jobs(unit, [(row, request.new) for row, request in fresh])
    keys = [(request.key, row["id"]) for row, request in fresh if request.key is not None]
    idempotency.remember(unit, keys)


_job = tables.job
_REUSABLE = (
    _job.c.state.in_(_REUSED),
    _job.c.damaged.is_(None),
    _job.c.state.in_(LIVE) | tables.unexpired(bindparam("now")),  # what is live never expires
)
_SAME_JOB = (
    select(_job.c.id)
    .where(
        _job.c.digest == bindparam("digest"),
        _job.c.solver_version == bindparam("solver_version"),
        _job.c.kind == bindparam("kind"),
        _job.c.owner == bindparam("owner"),
        *_REUSABLE,
    )
    .order_by(_job.c.id.desc())
    .limit(1)
)
_SAME_JOBS = (
    select(_job.c.digest, _job.c.solver_version, _job.c.kind, _job.c.owner, func.max(_job.c.id))
    .where(_job.c.digest.in_(bindparam("digests", expanding=True)), *_REUSABLE)
    .group_by(_job.c.digest, _job.c.solver_version, _job.c.kind, _job.c.owner)
)


def same_job(unit: Unit, new: NewJob) -> str | None:
    """Return the id of the job that `submit` would find: the newest that asks for the same.

    None if it ended badly, expired, or its results are damaged.

    The digest covers the filled-in job without its label, the version the solver's sources.
    """
    asked = {
        "digest": new.digest,
        "solver_version": new.solver_version,
        "kind": new.kind,
        "owner": new.owner,
        "now": unit.now,
    }
    found: str | None = unit.execute(_SAME_JOB, asked).scalar_one_or_none()
    return found


def row_of(job_id: str, new: NewJob, now: float, batch: str | None = None) -> Row:
    """Return the row of a new job, without the columns that have no value yet."""
    row = {name: getattr(new, name) for name in _OF_REQUEST}
    if new.scene is not None:
        row["scene"] = new.scene[:_LONGEST_NAME]
    row["kept_for"] = _longer(None, new, now)
    return {**_NEW_JOB, **row, "batch": batch or new.batch, "id": job_id, "created": now}


def _longer(lifetime: float | None, new: NewJob, now: float) -> float | None:
    """Return the longer of a lifetime [s] and that of a new submission; None: for ever."""
    if new.expires is None:
        return None
    return max(new.expires - now, lifetime or 0.0)


def insert_jobs(unit: Unit, jobs: Sequence[tuple[Row, NewJob]]) -> None:
    """Store rows of new jobs, all their blocks, wake-ups and first events."""
    now = unit.now
    unit.execute(insert(tables.job), [row for row, _ in jobs])
    blocks = [block for row, new in jobs for block in _blocks(row["id"], new)]
    alone = {row["id"] for row, new in jobs if len(new.blocks) == 1 and row["batch"] is None}
    unit.execute(insert(tables.block), blocks)
    owners = {row["id"]: row["owner"] for row, _ in jobs}
    queued = [block for block in blocks if block["state"] is BlockState.queued]
    places = [
        (INTERACTIVE_QUEUE if block["job"] in alone else FRESH_QUEUE, owners[block["job"]])
        for block in queued
    ]
    fresh = {"created": now, "due": now, "tries": 0}
    fair_queueing.arrive(unit, [owner for _, owner in places])
    wake_ups = [
        {"block": block["id"], "queue": queue, "owner": owner, **fresh}
        for block, (queue, owner) in zip(queued, places, strict=True)
    ]
    unit.execute(insert(tables.outbox), wake_ups)
    first = {"seq": 1, "time": now, "type": JobState.queued.value}
    data = {row["id"]: {"retry_of": new.retry_of} if new.retry_of else {} for row, new in jobs}
    events = [first | {"job": job, "data": facts} for job, facts in data.items()]
    unit.execute(insert(tables.event), events)
    retries.record(unit, [(new.retry_of, row["id"]) for row, new in jobs if new.retry_of])


def _blocks(job_id: str, new: NewJob) -> Iterator[Row]:
    cuts = [(first, count, BlockState.queued) for first, count in new.blocks]
    if new.seal:
        first, count = new.blocks[-1]
        cuts.append((first + count, 0, BlockState.waiting))
    for index, (first, count, state) in enumerate(cuts):
        place = {"id": f"{job_id}-{index}", "job": job_id, "index": index}
        yield {**_NEW_BLOCK, **place, "first": first, "count": count, "state": state}


def request_cancel(unit: Unit, job_id: str) -> Job:
    """Cancel a queued job at once, ask a running one to stop, leave a finished one alone.

    A block that a lost worker left behind has results; it stays queued, so that a worker closes
    its store properly. JobNotFound if there is no such job.
    """
    job = lock_job(unit, job_id)
    if job.state.terminal or job.state is JobState.cancelling:
        return labels.labelled_job(unit, job_id)
    block = tables.block
    drop_blocks(unit, block.c.job == job_id, untouched=True)
    live = unit.execute(
        select(func.count()).where(block.c.job == job_id, block.c.state.in_(_LIVE))
    ).scalar_one()
    if job.state is JobState.running:
        step_job(unit, job_id, JobState.cancelling)
    if not live:
        step_job(unit, job_id, JobState.cancelled)
    return labels.labelled_job(unit, job_id)


def drop_blocks(unit: Unit, of: ColumnElement[bool], *, untouched: bool) -> None:
    """Cancel those among some blocks that no worker holds, or ever held; forget their wake-ups."""
    block, outbox = tables.block, tables.outbox
    dropped = and_(of, block.c.state.in_((BlockState.queued, BlockState.waiting)))
    if untouched:
        dropped = and_(dropped, block.c.attempt == 0)
    # from the blocks to their wake-ups, of which there may be 100 000 of others
    unit.execute(delete(outbox).where(outbox.c.block.in_(select(block.c.id).where(dropped))))
    unit.execute(update(block).where(dropped).values(state=BlockState.cancelled))
