"""Keys that submissions are remembered by, so that one that comes again is answered as before."""

from collections.abc import Hashable, Sequence
from typing import Any, Final

from sqlalchemy import bindparam, delete, insert, or_, select

from jointplay.storage.catalogue import labels, tables
from jointplay.storage.catalogue.connections import Unit
from jointplay.storage.catalogue.errors import KeyReused
from jointplay.storage.catalogue.records import TERMINAL, SubmissionKey, Submitted

_table = tables.idempotency
_job = tables.job
_there = or_(
    _table.c.job.is_(None), _job.c.state.not_in(TERMINAL), tables.unexpired(bindparam("now"))
)
_OF_KEYS: Final = (
    select(_table, _there.label("there"))
    .outerjoin(_job, _job.c.id == _table.c.job)
    .where(_table.c.key.in_(bindparam("keys", expanding=True)))
)


def answers(unit: Unit, keys: Sequence[str]) -> dict[Hashable, Any]:
    """Return rows of what keys were answered with, by the keys as they are stored."""
    return {row.key: row for row in unit.execute(_OF_KEYS, {"keys": keys, "now": unit.now})}


def earlier_answer(unit: Unit, key: SubmissionKey) -> Any | None:
    """Find what a key was answered with (its job or batch), if it is still remembered.

    Raises
    ------
    KeyReused
        It was used for another request.
    """
    return still_counting(unit, key, answers(unit, [key.stored]).get(key.stored))


def still_counting(unit: Unit, key: SubmissionKey, row: Any | None) -> Any | None:
    """Return the row of a key, if there is one and it is still remembered; or KeyReused."""
    if row is None:
        return None
    if not _counts(unit, row):
        unit.execute(delete(_table).where(_table.c.key == key.stored))
        return None
    if row.fingerprint != key.fingerprint:
        raise KeyReused(key.key)
    return row


def remembered(unit: Unit, key: SubmissionKey) -> Any | None:
    """Return what `earlier_answer` does, and write nothing."""
    row = answers(unit, [key.stored]).get(key.stored)
    return None if row is None or not _counts(unit, row) else still_counting(unit, key, row)


def job_submitted_by(unit: Unit, key: SubmissionKey) -> Submitted | None:
    """Return what an earlier request with a key was answered with, if it was a job.

    Raises
    ------
    KeyReused
        The key was used for another request.
    """
    row = remembered(unit, key)
    return None if row is None or row.job is None else submitted_before(unit, row)


def submitted_before(unit: Unit, row: Any) -> Submitted:
    """Return the job of a key's row."""
    job = labels.labelled_job(unit, row.job)
    # a key is stored with the job that it made, and later than one that it found
    return Submitted(job, created=False, cached=row.created > job.created)


def _counts(unit: Unit, row: Any) -> bool:
    """Whether a key is remembered still, and its answer is there and can be read."""
    answered = row.job is not None or row.batch is not None
    return bool(row.expires > unit.now and answered and row.there)


def remember(unit: Unit, jobs: Sequence[tuple[SubmissionKey, str]]) -> None:
    """Have keys find jobs, by their ids, while they are remembered."""
    if jobs:
        unit.execute(insert(_table), [_row(unit, key) | {"job": job} for key, job in jobs])


def remember_batch(unit: Unit, key: SubmissionKey, batch: str) -> None:
    """Have a key find this batch while it is remembered."""
    unit.execute(insert(_table), _row(unit, key) | {"batch": batch})


def forget_batch(unit: Unit, batch: str) -> None:
    """Have no key find a batch."""
    unit.execute(delete(_table).where(_table.c.batch == batch))


def _row(unit: Unit, key: SubmissionKey) -> dict[str, Any]:
    times = {"created": unit.now, "expires": unit.now + key.seconds}
    return {"key": key.stored, "fingerprint": key.fingerprint, **times}
