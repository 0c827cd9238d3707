"""Bytes that the results of owners' jobs take, measured once a job has ended."""

from collections.abc import Mapping

from sqlalchemy import bindparam, func, select, update

from jointplay.storage.catalogue import tables
from jointplay.storage.catalogue.connections import Unit

_job = tables.job


def unmeasured(unit: Unit, limit: int) -> tuple[str, ...]:
    """Return ended jobs of owners whose results nobody has measured yet."""
    found = select(_job.c.id).where(tables.UNMEASURED).order_by(_job.c.id).limit(limit)
    return tuple(unit.execute(found).scalars())


def note_stored(unit: Unit, sizes: Mapping[str, int]) -> None:
    """Remember the bytes of jobs' results."""
    rows = [{"job": job, "size": size} for job, size in sorted(sizes.items())]
    if rows:
        measured = update(_job).where(_job.c.id == bindparam("job"))
        unit.execute(measured.values(stored=bindparam("size")), rows)


def bytes_of(unit: Unit, owner: str) -> int:
    """Return the bytes of an owner's results that are there."""
    there = (tables.MEASURED, _job.c.owner == owner)
    return int(unit.execute(select(func.sum(_job.c.stored)).where(*there)).scalar_one() or 0)
