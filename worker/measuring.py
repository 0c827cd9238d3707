"""Measuring the results of owners' jobs that have ended, for their quotas."""

import logging

from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import Unavailable
from jointplay.storage.settings import Settings

_AT_ONCE = 50
_log = logging.getLogger(__name__)


def measure_results(catalogue: Catalogue, settings: Settings) -> None:
    """Note the bytes of some jobs' results; what cannot be measured is tried again."""
    sizes = {}
    try:
        for job in catalogue.unmeasured(_AT_ONCE):
            try:
                sizes[job] = _size(catalogue, settings, job)
            except OSError as fault:  # that of one job keeps no others' from being noted
                _log.warning("results of job %s are not measured now: %s", job, fault)
        catalogue.note_stored(sizes)
    except Unavailable as fault:
        _log.warning("results are not measured now: %s", fault)


def _size(catalogue: Catalogue, settings: Settings, job_id: str) -> int:
    """Sum up the bytes of sealed results, or, where there are none, of what a job left."""
    store = settings.object_store
    sealed = sum(store.size(key) for key in store.list(settings.results_prefix(job_id)))
    job = catalogue.get(job_id)
    whole = settings.sealed_run(job.id, job.attempt), settings.sealed_study(job.id)
    if any(results.exists() for results in whole):
        return sealed  # what it needed while it ran goes
    files = settings.running_files(job_id)
    return sealed + sum(files.size(name) for name in files.names())
