"""Results without a job: the catalogue was lost or is an older copy, and they were kept."""

from sqlalchemy import delete, exists, select, update

from jointplay.storage.catalogue import tables
from jointplay.storage.catalogue.connections import Unit
from jointplay.storage.catalogue.identifiers import time_of
from jointplay.storage.catalogue.records import BlockState, JobState, NewJob
from jointplay.storage.catalogue.rows import record_event
from jointplay.storage.catalogue.submission import insert_jobs, row_of


def adopt(unit: Unit, job_id: str, new: NewJob, attempt: int, steps: int | None) -> None:
    """Make the job of whole results that has none, as one that has succeeded now.

    Parameters
    ----------
    job_id, attempt
        As the name of the results says; the job's creation is in its id.
    new
        As the results describe it.
    steps
        Of the solver, if the results say.
    """
    if unit.execute(select(exists().where(tables.job.c.id == job_id))).scalar_one():
        return
    insert_jobs(unit, [(row_of(job_id, new, time_of(job_id)), new)])
    blocks = tables.block.c.job == job_id
    of_job = select(tables.block.c.id).where(blocks)
    unit.execute(delete(tables.outbox).where(tables.outbox.c.block.in_(of_job)))
    done = {"state": BlockState.done, "attempt": attempt, "progress_fraction": 1.0}
    unit.execute(update(tables.block).where(blocks).values(done))
    ended = {
        "state": JobState.succeeded,
        "attempt": attempt,
        "finished": unit.now,  # as far as it is known: until there is a time, clients wait
        "steps": steps,
        "progress_fraction": 1.0,
        "progress_time": float(new.spec.get("duration") or 0.0),
    }
    unit.execute(update(tables.job).where(tables.job.c.id == job_id).values(ended))
    record_event(unit, job_id, JobState.succeeded.value, {})
