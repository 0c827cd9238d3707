"""Measuring the results of owners' jobs that have ended, for their quotas."""

import logging

from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.settings import Settings
from jointplay.worker.passing import PASSING

_AT_ONCE = 50
_log = logging.getLogger(__name__)


def measure_results(catalogue: Catalogue, settings: Settings) -> None:
    """Note the bytes of some jobs' sealed results; what cannot be measured is tried again."""
    try:
        jobs = catalogue.unmeasured(_AT_ONCE)
        catalogue.note_stored({job: _size(settings, job) for job in jobs})
    except PASSING as fault:
        _log.warning("results are not measured now: %s", fault)


def _size(settings: Settings, job: str) -> int:
    place = settings.place
    return sum(place.size(key) for key in place.list(settings.results_prefix(job)))
