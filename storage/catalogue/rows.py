"""Small statements that every part of the catalogue needs: find a job, move it, note an event."""

from collections.abc import Mapping
from dataclasses import asdict
from functools import cache
from typing import Any, Final

from sqlalchemy import ColumnElement, Update, bindparam, case, func, insert, select, update

from jointplay.records.job import JobError
from jointplay.storage.catalogue import tables
from jointplay.storage.catalogue.connections import Unit
from jointplay.storage.catalogue.errors import JobNotFound
from jointplay.storage.catalogue.records import LEGAL_STEPS, Job, JobState

LEAST_KEPT: Final = 86_400.0
"""Seconds for which a job is kept from its end on, if it was to be kept as long as that."""
job_table = tables.job
_event = tables.event
# made once: to make a statement takes longer than SQLite takes to execute it
_FIND: Final = select(job_table).where(job_table.c.id == bindparam("of_job"))
_LOCK: Final = _FIND.with_for_update(key_share=True)
_LAST: Final = select(func.coalesce(func.max(_event.c.seq), 0)).where(
    _event.c.job == bindparam("of_job")
)
_RECORD: Final = insert(_event).values(
    job=bindparam("of_job"),
    seq=_LAST.scalar_subquery() + 1,
    time=bindparam("moment"),
    type=bindparam("kind"),
    data=bindparam("facts", type_=_event.c.data.type),
)


def find_job(unit: Unit, job: str, *, locked: bool = False) -> Job:
    """Return a job; JobNotFound if there is none."""
    row = unit.execute(_LOCK if locked else _FIND, {"of_job": job}).one_or_none()
    if row is None:
        raise JobNotFound(job)
    return Job(**row._mapping)


def lock_job(unit: Unit, job: str) -> Job:
    """Return a job and keep others from changing it until the unit ends (SQLite: they wait).

    Comes before every change of its blocks: two units that lock both in one order never wait for
    each other.
    """
    return find_job(unit, job, locked=True)


def step_job(unit: Unit, job: str, to: JobState, *, error: JobError | None = None) -> bool:
    """Move a job to a state and record the event, if its present state allows the step.

    Returns whether it does.
    """
    values: dict[str, Any] = {} if error is None else {"failure": error}
    if to.terminal:
        values["moment"] = unit.now
    step = _step(to, failed=error is not None)
    if not unit.execute(step, {"of_job": job, **values}).rowcount:
        return False
    record_event(unit, job, to.value, {"error": asdict(error)} if error else {})
    return True


@cache
def _step(to: JobState, *, failed: bool) -> Update:
    allowed = [state for state, steps in LEGAL_STEPS.items() if to in steps]
    may_step = (job_table.c.id == bindparam("of_job"), job_table.c.state.in_(allowed))
    values: dict[str, Any] = {"state": to}
    if failed:
        values["error"] = bindparam("failure", type_=job_table.c.error.type)
    if to.terminal:
        moment = bindparam("moment", type_=job_table.c.finished.type)
        values |= {"finished": moment, "expires": _kept_from(moment)}
    return update(job_table).where(*may_step).values(values)


def _kept_from(moment: ColumnElement[float]) -> ColumnElement[float | None]:
    """Return when a job that ends at a moment expires: its results can be read for a while."""
    expires, created = job_table.c.expires, job_table.c.created
    lifetime = func.coalesce(job_table.c.kept_for, expires - created)
    least = moment + case((lifetime > LEAST_KEPT, LEAST_KEPT), else_=lifetime)
    return case((expires < least, least), else_=expires)


def record_event(unit: Unit, job: str, kind: str, data: Mapping[str, Any]) -> None:
    """Append an event; the job must be locked or just changed in this unit."""
    row = {"of_job": job, "moment": unit.now, "kind": kind, "facts": dict(data)}
    unit.execute(_RECORD, row)
