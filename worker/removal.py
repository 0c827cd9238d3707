"""Removing what nobody will read: expired or deleted jobs, what late attempts wrote."""

import logging
from contextlib import suppress
from typing import TYPE_CHECKING

from jointplay.records.log_lines import about
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import CatalogueError, JobNotFound, Unavailable
from jointplay.storage.catalogue.records import Block
from jointplay.storage.settings import Settings
from jointplay.worker.holding import Holding
from jointplay.worker.transient_faults import TRANSIENT

if TYPE_CHECKING:
    from jointplay.storage.reconciliation.finding import Finding

_AT_ONCE = 50
_log = logging.getLogger(__name__)


def remove_expired(catalogue: Catalogue, settings: Settings) -> None:
    """Remove the results of some expired jobs; what cannot be removed is tried again.

    It takes seconds a job where disks are slow.
    """
    try:
        due = catalogue.removable(_AT_ONCE)
        jobs = catalogue.give_up(due) if due else ()
    except Unavailable as fault:
        _log.warning("nothing is removed now: %s", fault)
        return
    for job in jobs:
        with about(job=job):
            _remove(catalogue, settings, job)


def _remove(catalogue: Catalogue, settings: Settings, job: str) -> None:
    try:
        settings.object_store.remove(settings.results_prefix(job))
        settings.running_files(job).clear()  # of a job that ended without results
        catalogue.mark_removed([job])
    except TRANSIENT as error:
        _log.warning("the results of job %s cannot be removed: %s", job, error)
        return
    _log.info("removed the results of job %s", job)


def tidy(settings: Settings, block: Block) -> None:
    """Remove what is of no use when a job has ended with an attempt at one of its blocks.

    Of a study that ended without being sealed everything stays: other blocks may still arrive.
    """
    with suppress(OSError):  # the relay does it a lease later
        if settings.sealed_run(block.job, block.attempt).exists():
            for attempt in range(1, block.attempt):
                lost = settings.sealed_run(block.job, attempt)
                lost.object_store.remove(lost.key)
        elif not settings.sealed_study(block.job).exists():
            return
        for left in [*settings.object_store.cut_off(settings.results_prefix(block.job))]:
            settings.object_store.remove(left)  # of who was killed while it sealed
        settings.running_files(block.job).clear()


def clear_up(catalogue: Catalogue, settings: Settings) -> int:
    """Remove what jobs needed that ended a lease ago. Returns the number of these jobs.

    Their last worker may have ended before it could, or the object store have been out of reach.
    """
    removed = 0
    try:
        if any(_has_ended(catalogue, job) for job in settings.running_jobs()):
            # half a second to load, which most relays never need
            from jointplay.storage.reconciliation.leftovers import of_running_jobs

            for finding in of_running_jobs(settings, catalogue, settings.lease):
                removed += _removed(finding)
    except TRANSIENT as fault:
        _log.warning("what jobs left stays for now: %s", fault)
    return removed


def _removed(finding: "Finding") -> bool:
    """Remove what was left, unless a fault keeps it: that of one job leaves others' to go."""
    if finding.mend is None:
        return False
    try:
        finding.mend()
    except TRANSIENT as fault:
        _log.warning("%s stays for now: %s", finding.subject, fault)
        return False
    _log.info("removed %s, which was left", finding.subject)
    return True


def _has_ended(catalogue: Catalogue, job_id: str) -> bool:
    try:
        return catalogue.get(job_id).state.terminal
    except JobNotFound:
        return False


def withdraw(catalogue: Holding, settings: Settings, block: Block) -> None:
    """Remove what an attempt wrote after the job had ended without it; never raises."""
    attempt = block.attempt
    try:
        job = catalogue.get(block.job)
        if not job.state.terminal:
            return  # the attempt that ends the job removes everything
        if job.attempt != attempt:
            settings.object_store.remove(settings.sealed_run(job.id, attempt).key)
        sealed = settings.sealed_run(job.id, job.attempt), settings.sealed_study(job.id)
        if any(results.exists() for results in sealed):
            settings.running_files(job.id).clear()
    except (CatalogueError, OSError) as error:
        _log.warning("what attempt %d of %s left stays: %s", attempt, block.job, error)
