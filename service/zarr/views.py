"""From a job and a key to bytes: of a finished store as stored, of a growing one as committed."""

import json
import time
from typing import Final

from service.jobs.results_of_kinds import is_study
from service.results.stores import committed_so_far
from service.zarr.content import Content
from storage.catalogue import Catalogue, Job
from storage.results import NotAStore
from storage.results.layout import MANIFEST
from storage.results.live import LiveStore, loosened
from storage.results.metadata import FILE
from storage.settings import Settings

_GRACE: Final = 600.0
"""Seconds in which clients that opened a running job's store may still read on."""


def content_of(job: Job, key: str, catalogue: Catalogue, settings: Settings) -> Content | None:
    """Return what a key of the job's store holds, or None."""
    if is_study(job):
        return Content.of_file(settings.study_folder(job.id), key)
    sealed = settings.result_folder(job.id, job.attempt)
    if (sealed / MANIFEST).exists():
        return Content.of_file(sealed, key)
    folder, samples = committed_so_far(job, catalogue, settings)
    if not key.endswith(FILE) and (stored := Content.of_file(folder, key)):
        return stored
    try:
        store = LiveStore(folder, samples)
    except NotAStore:
        return None
    made = store.document(key) if key.endswith(FILE) else store.chunk(key)
    return None if made is None else Content.of_bytes(made)


def former_content(
    job: Job, key: str, content: Content, catalogue: Catalogue, settings: Settings
) -> Content | None:
    """Return a shard as it was served before it was full; None where it never was.

    A client that read the index of the growing shard asks for bytes behind the finished one.
    """
    lately = job.finished is None or time.time() - job.finished < _GRACE
    if is_study(job) or not lately or key.endswith(FILE):
        return None
    array_key = key.rpartition("/c/")[0]
    folder = settings.result_folder(job.id, job.attempt)
    if not (folder / MANIFEST).exists():
        folder, _ = committed_so_far(job, catalogue, settings)
    members = json.loads((folder / FILE).read_bytes())["consolidated_metadata"]["metadata"]
    made = loosened(members.get(array_key), content.read(0, content.size))
    return None if made is None else Content.of_bytes(made)
