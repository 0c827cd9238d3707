"""Removing what expired or deleted jobs have computed."""

import logging
import shutil

from jointplay.storage.catalogue import Catalogue
from jointplay.storage.settings import Settings

_AT_ONCE = 50
_log = logging.getLogger(__name__)


def remove_expired(catalogue: Catalogue, settings: Settings) -> None:
    """Remove the results of some expired jobs; what cannot be removed is tried again.

    It takes seconds a job where disks are slow.
    """
    for job in catalogue.removable(_AT_ONCE):
        try:
            settings.place.remove(settings.results_prefix(job))
            if (folder := settings.running_folder(job)).exists():  # it ended without results
                shutil.rmtree(folder)
        except OSError as error:
            _log.warning("the results of job %s cannot be removed: %s", job, error)
            continue
        catalogue.mark_removed([job])
        _log.info("removed the results of job %s", job)
