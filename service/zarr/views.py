"""From a job and a key to bytes: of a finished store as stored, of a growing one as committed."""

import json
import time
from functools import lru_cache
from typing import Final

from jointplay.records.channel import Channel
from jointplay.service.jobs.results_of_kinds import is_study
from jointplay.service.results.stores import committed_so_far, packed, sealed_of
from jointplay.service.zarr.content import Content
from jointplay.solver.runs.study.outputs import OUTPUTS
from jointplay.storage.catalogue import Catalogue, Job
from jointplay.storage.packed import Files
from jointplay.storage.results import NotAStore
from jointplay.storage.results.live import LiveStore, loosened
from jointplay.storage.results.metadata import FILE
from jointplay.storage.settings import Settings
from jointplay.storage.studies.live import LiveStudy

_FRESH: Final = 0.5
"""Seconds for which the parts of a running study are not read again."""
_OUTPUTS: Final = {name: Channel(name, *output) for name, output in OUTPUTS.items()}
_GRACE: Final = 600.0
"""Seconds in which clients that opened a running job's store may still read on."""


def content_of(job: Job, key: str, catalogue: Catalogue, settings: Settings) -> Content | None:
    """Return what a key of the job's store holds, or None."""
    try:
        content = Content.of_file(packed(sealed_of(job, settings)), key)
        if content is not None:
            content.final = job.state.terminal
        return content
    except NotAStore:
        pass
    try:
        store = _live(job, catalogue, settings)
        if not key.endswith(FILE) and (stored := Content.of_file(store.files, key)):
            return stored
        made = store.document(key) if key.endswith(FILE) else store.chunk(key)
    except NotAStore:
        return None
    return None if made is None else Content.of_bytes(made)


def _live(job: Job, catalogue: Catalogue, settings: Settings) -> LiveStore | LiveStudy:
    """Return what is known of a running job, for many requests.

    Of a run at one of its checkpoints, for the second until the next; of a study as of at most
    `_FRESH` seconds ago.
    """
    if is_study(job):
        return _study_at(settings, job.id, time.monotonic() // _FRESH)
    return _run_at(settings, job.id, *committed_so_far(job, catalogue))


@lru_cache(maxsize=2)
def _run_at(settings: Settings, job: str, attempt: int, samples: int) -> LiveStore:
    return LiveStore(settings.running_run(job, attempt), samples)


@lru_cache(maxsize=4)
def _study_at(settings: Settings, job: str, moment: float) -> LiveStudy:
    return LiveStudy(settings.running_study(job), _OUTPUTS)


def former_content(
    job: Job, key: str, content: Content, catalogue: Catalogue, settings: Settings
) -> Content | None:
    """Return a shard as it was served before it was full; None where it never was.

    A client that read the index of the growing shard asks for bytes behind the finished one.
    """
    lately = job.finished is None or time.time() - job.finished < _GRACE
    if is_study(job) or not lately or key.endswith(FILE):
        return None
    files: Files
    try:
        files = packed(sealed_of(job, settings))
    except NotAStore:
        files = _live(job, catalogue, settings).files
    members = json.loads(files.read(FILE))["consolidated_metadata"]["metadata"]
    made = loosened(members.get(key.rpartition("/c/")[0]), content.read(0, content.size))
    return None if made is None else Content.of_bytes(made)
