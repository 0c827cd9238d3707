"""Labels that a job was asked for with after its first one, as an answer to later requests."""

from collections.abc import Sequence
from dataclasses import replace
from itertools import groupby
from typing import Final

from sqlalchemy import ColumnElement, func, insert, or_, select

from jointplay.storage.catalogue import tables
from jointplay.storage.catalogue.connections import Unit
from jointplay.storage.catalogue.records import Job
from jointplay.storage.catalogue.rows import find_job

MOST: Final = 1000
"""Further labels that a job keeps; those after them are not kept."""
_job, _label = tables.job, tables.label


def add(unit: Unit, job: Job, label: str) -> None:
    """Keep one more label of a job, unless it has that one."""
    of_job = _label.c.job == job.id
    if (
        label == job.label
        or unit.execute(select(_label.c.job).where(of_job, _label.c.label == label)).one_or_none()
    ):
        return
    kept = unit.execute(select(func.count()).select_from(_label).where(of_job)).scalar_one()
    if kept < MOST:
        unit.execute(insert(_label).values(job=job.id, label=label))


def is_label(name: str) -> ColumnElement[bool]:
    """Return the condition that a job was asked for with a label."""
    further = select(_label.c.job).where(_label.c.label == name)
    return or_(_job.c.label == name, _job.c.id.in_(further))


def labelled(unit: Unit, jobs: Sequence[Job]) -> list[Job]:
    """Return jobs with their further labels, in order of these."""
    rows = unit.execute(
        select(_label.c.job, _label.c.label)
        .where(_label.c.job.in_([job.id for job in jobs]))
        .order_by(_label.c.job, _label.c.label)
    )
    found = {
        job: tuple(label for _, label in some) for job, some in groupby(rows, lambda row: row[0])
    }
    return [replace(job, further_labels=found[job.id]) if job.id in found else job for job in jobs]


def labelled_job(unit: Unit, job_id: str) -> Job:
    """Return a job with its further labels; JobNotFound if there is none."""
    (job,) = labelled(unit, [find_job(unit, job_id)])
    return job
