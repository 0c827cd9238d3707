"""From a job and a key to bytes: of a finished store as stored, of a growing one as committed."""

import json
import time
from functools import lru_cache
from pathlib import Path
from typing import Final

from jointplay.records.channel import Channel
from jointplay.service.jobs.results_of_kinds import is_study
from jointplay.service.results.stores import committed_so_far
from jointplay.service.zarr.content import Content
from jointplay.solver.runs.study.outputs import OUTPUTS
from jointplay.storage.catalogue import Catalogue, Job
from jointplay.storage.results import NotAStore
from jointplay.storage.results.layout import MANIFEST
from jointplay.storage.results.live import LiveStore, loosened
from jointplay.storage.results.metadata import FILE
from jointplay.storage.settings import Settings
from jointplay.storage.studies.live import LiveStudy

_FRESH: Final = 0.5
"""Seconds for which the parts of a running study are not read again."""
_OUTPUTS: Final = {name: Channel(name, *meaning) for name, meaning in OUTPUTS.items()}
_GRACE: Final = 600.0
"""Seconds in which clients that opened a running job's store may still read on."""


def content_of(job: Job, key: str, catalogue: Catalogue, settings: Settings) -> Content | None:
    """Return what a key of the job's store holds, or None."""
    study = is_study(job)
    folder = settings.study_folder(job.id) if study else settings.result_folder(job.id, job.attempt)
    if (folder / MANIFEST).exists():
        content = Content.of_file(folder, key)
        if content is not None:
            content.final = job.state.terminal
        return content
    samples = 0
    if not study:
        folder, samples = committed_so_far(job, catalogue, settings)
    if not key.endswith(FILE) and (stored := Content.of_file(folder, key)):
        return stored
    try:
        store = _live_study(folder) if study else _live_store(folder, samples)
    except NotAStore:
        return None
    made = store.document(key) if key.endswith(FILE) else store.chunk(key)
    return None if made is None else Content.of_bytes(made)


@lru_cache(maxsize=2)
def _live_store(folder: Path, samples: int) -> LiveStore:
    """Return a run at one of its checkpoints, for the requests of the second until the next."""
    return LiveStore(folder, samples)


def _live_study(folder: Path) -> LiveStudy:
    """Return what is known of a study: as of at most `_FRESH` seconds ago, for many requests."""
    return _study_at(folder, time.monotonic() // _FRESH)


@lru_cache(maxsize=4)
def _study_at(folder: Path, moment: float) -> LiveStudy:
    return LiveStudy(folder, _OUTPUTS)


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
