"""From a job and a key to bytes: of a finished store as stored, of a growing one as committed."""

import json
import re
import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache, partial
from hashlib import sha256
from typing import Final, Self

from jointplay.records.channel import Channel
from jointplay.records.point_numbers import OUTPUTS
from jointplay.service.results.stores import ResultsOfJob
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.errors import CorruptStore, LostObject, NotAStore
from jointplay.storage.identity import growing_study
from jointplay.storage.packed import Files
from jointplay.storage.results.live import LiveStore, loosened
from jointplay.storage.results.metadata import FILE
from jointplay.storage.settings import Settings
from jointplay.storage.studies.live import LiveStudy

_FRESH: Final = 0.5
"""Seconds for which the parts of a running study are not read again."""
_OUTPUTS: Final = {name: Channel(name, *output) for name, output in OUTPUTS.items()}
_GRACE: Final = 600.0
"""Seconds in which clients that opened a running job's store may still read on."""
INTERNAL: Final = ("pyramid/", "steps/")
"""Groups of what the service reads itself and no client is shown."""

_KEY: Final = re.compile(
    r"(?:(?!\.)[A-Za-z0-9_.-]{1,96}/){0,4}(?:zarr\.json|c(?:/\d{1,9}){0,4})", re.ASCII
)


def is_key(text: str) -> bool:
    """Tell whether a text can name a metadata document or a chunk of a store.

    Asked before any path is touched: nothing else can leave the store's folder, name what is
    hidden in it, or be too long for a file system.
    """
    return _KEY.fullmatch(text) is not None and not text.startswith(INTERNAL)


@dataclass
class Content:
    """One representation of a key."""

    size: int
    tag: str
    """Strong entity tag, in its quotes."""
    read: Callable[[int, int], bytes]
    """Gives bytes [start, stop)."""
    final: bool = False
    """The key will never hold anything else."""

    @classmethod
    def of_file(cls, files: Files, key: str) -> Self | None:
        """Take a file of a store; None if it is not there.

        A chunk is stored once, so that its checksum tells it from what was made before.
        """
        try:
            entry = files.entry(key)
        except FileNotFoundError:
            return None
        return cls(entry.size, f'"{entry.crc:08x}-{entry.size:x}"', partial(files.read, key))

    @classmethod
    def of_bytes(cls, content: bytes) -> Self:
        """Take bytes that were made."""
        tag = f'"{sha256(content).hexdigest()[:32]}"'
        return cls(len(content), tag, lambda start, stop: content[start:stop])


def content_of(results: ResultsOfJob, key: str) -> Content | None:
    """Return what a key of the job's store holds, or None.

    Raises
    ------
    CorruptStore
        It is damaged, or gone.
    """
    whole = results.whole()
    if whole is not None:
        content = Content.of_file(whole.files, key)
        if content is not None:
            content.final = results.job.state.terminal
        return content
    try:
        store = _live(results)
    except NotAStore:
        results.require_computed()
        return None
    if key.endswith(FILE):
        made = store.document(key)
    elif stored := Content.of_file(store.files, key):
        return stored
    elif store.in_file(key):
        raise LostObject(f"{key} was written and is gone")
    else:
        made = store.chunk(key)
    return None if made is None else Content.of_bytes(made)


def _live(results: ResultsOfJob) -> LiveStore | LiveStudy:
    """Return what is known of a running job, for many requests.

    Of a run at one of its checkpoints, for the second until the next; of a study as of at most
    `_FRESH` seconds ago.
    """
    store: LiveStore | LiveStudy
    try:
        if results.is_study:
            moment = time.monotonic() // _FRESH
            store = _study_at(results.settings, results.catalogue, results.job.id, moment)
        else:
            store = _run_at(results.settings, results.job.id, *results.committed())
    except CorruptStore:
        results.require_own()
        raise
    results.require_own(store.attributes)
    return store


@lru_cache(maxsize=2)
def _run_at(settings: Settings, job: str, attempt: int, samples: int) -> LiveStore:
    return LiveStore(settings.running_run(job, attempt), samples)


@lru_cache(maxsize=4)
def _study_at(settings: Settings, catalogue: Catalogue, job: str, moment: float) -> LiveStudy:
    return LiveStudy(growing_study(settings, catalogue, job), _OUTPUTS)


def former_content(results: ResultsOfJob, key: str, content: Content) -> Content | None:
    """Return a shard as it was served before it was full; None where it never was.

    A client that read the index of the growing shard asks for bytes behind the finished one.
    """
    finished = results.job.finished
    lately = finished is None or results.catalogue.clock() - finished < _GRACE
    if results.is_study or not lately or key.endswith(FILE):
        return None
    whole = results.whole()
    files = _live(results).files if whole is None else whole.files
    members = json.loads(files.read(FILE))["consolidated_metadata"]["metadata"]
    made = loosened(members.get(key.rpartition("/c/")[0]), content.read(0, content.size))
    return None if made is None else Content.of_bytes(made)
