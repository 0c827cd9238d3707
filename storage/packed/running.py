"""The files of a store that is being filled: a few packed ones.

``documents.zip`` holds the documents and is replaced; ``rows`` has a packed file for the chunks of
all columns at one index, such as ``history-3.zip``, which is written once, when they are full.
Chunks of extremes are small: one file has several, such as ``pyramid-64-8-11.zip``.
"""

import json
import os
from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping
from contextlib import suppress
from functools import cached_property
from pathlib import Path
from typing import Any, Final, TypeVar

from jointplay.storage import durable
from jointplay.storage.errors import CorruptStore, LostObject, NotAStore
from jointplay.storage.object_stores import StoredObject
from jointplay.storage.packed.ranges import InMemory
from jointplay.storage.packed.reading import Entry, Packed
from jointplay.storage.packed.writing import pack
from jointplay.storage.running_files import RunningFiles
from jointplay.storage.running_files.folder import InFolder

DOCUMENTS: Final = "documents.zip"
ROWS: Final = "rows"
PARTS: Final = "parts"
"""Folder of what is not stored yet: the journal of a run, the parts of a study's blocks."""
_PATIENCE: Final = 10_000
_TOGETHER: Final = {"pyramid": 4}
"""Chunk indices in one file, by the first part of the group's name."""
Found = TypeVar("Found")


class Running:
    """Files of a running store; memory is bounded by its documents.

    Parameters
    ----------
    source
        Files below the store's name, or the folder of one that is filled here; need not be there.
    sealed
        Where the store will be once it is sealed. The folder goes then; what is not found in it
        any more is read there, where every chunk has the same bytes.
    digest
        Of what is computed: rows of anything else are damage. By default that of the documents.
    """

    def __init__(
        self,
        source: RunningFiles | Path,
        sealed: StoredObject | None = None,
        digest: str | None = None,
    ) -> None:
        self._source = InFolder(source) if isinstance(source, Path) else source
        self._target = sealed
        self._digest = digest
        self._packed: Packed | None = None
        self._synced = False
        self._packs: dict[str, tuple[str, Packed]] = {}

    def __str__(self) -> str:
        return str(self._source)

    @property
    def name(self) -> str:
        """Name of the store among those of its job."""
        return self._source.name

    @property
    def folder(self) -> Path:
        """Where a store is filled, which must be on this machine."""
        if not isinstance(self._source, InFolder):
            raise TypeError(f"{self} is not in a folder of this machine")
        return self._source.path

    def write_documents(self, entries: Iterable[tuple[str, bytes]]) -> None:
        """Replace the documents: readers see all of them or none, a power cut may take them."""
        make_folders(self.folder)
        durable.write(self.folder / DOCUMENTS, pack(entries), lasting=False)

    def write(self, entries: Iterable[tuple[str, bytes]], key: str) -> None:
        """Write the chunks that share a file with that of a key; durable on return."""
        self._sync_folders()
        durable.write(self._path(key), pack(entries, self.digest))

    def adopt(self, lost: "Running", key: str) -> None:
        """Take over a lost attempt's file with the chunk of a key; durable on return.

        Raises
        ------
        FileNotFoundError
            They are not there.
        CorruptStore
            They have other bytes than were written.
        """
        lost.check(key)
        self._sync_folders()
        source, path = lost._path(key), self._path(key)
        try:
            os.link(source, path)
            durable.sync(path.parent)
        except OSError:  # another file system, or one that cannot link; or the source is gone
            durable.write(path, [source.read_bytes()])

    def has(self, key: str) -> bool:
        """Whether the chunks of a key's index were written, and the folder is there."""
        return self._source.has(self.file_of(key))

    @staticmethod
    def file_of(key: str) -> str:
        """Name the file that has the chunk of a key, below the folder."""
        return f"{ROWS}/{_name(key)}"

    def shards(self, pattern: str) -> int:
        """Count the shards of an array that were written, whose keys are made by a pattern.

        Raises
        ------
        LostObject
            One is gone: the one behind it is there.
        """
        found, step = 0, indices_in_file(pattern)
        while self.has(pattern.format(found)):
            found += step
        lost = pattern.format(found)
        if self.has(pattern.format(found + step)) and not self.has(lost):
            raise LostObject(f"{self.name} lacks {lost}, which had been written")
        return found

    def check(self, key: str) -> None:
        """Compare the chunks that share a file with that of a key with their checksums.

        Raises
        ------
        FileNotFoundError
            They are not there.
        CorruptStore
            They have other bytes than were written.
        """
        for _ in self.chunks(key):
            pass

    def verify(self) -> None:
        """Compare all files but those of `PARTS` with their checksums.

        Raises
        ------
        NotAStore
            There are no documents.
        CorruptStore
            A file has other bytes than were written.
        """
        objects = [self._source.object(name) for name in self._source.names(ROWS)]
        for packed in (self.documents, *(Packed(one, self.digest) for one in objects)):
            for key in packed:
                packed.read(key)

    def chunks(self, key: str) -> Iterator[tuple[str, bytes]]:
        """Yield key and content of all chunks that share a file with that of a key."""
        found = self._pack(key)
        for one in found:
            yield one, found.read(one)

    def __iter__(self) -> Iterator[str]:
        """Yield the keys of the documents."""
        return iter(self.documents)

    def read(self, key: str, start: int = 0, stop: int | None = None) -> bytes:
        """Return bytes [start, stop) of a file, to its end by default."""
        return self._ask(key, lambda files: files.read(key, start, stop))

    def entry(self, key: str) -> Entry:
        """Return size and CRC-32 of a file; FileNotFoundError if there is none."""
        return self._ask(key, lambda files: files.entry(key))

    def sealed(self) -> Packed | None:
        """Return the sealed store, if there is one by now."""
        if self._packed is None and self._target is not None and self._target.exists():
            self._packed = Packed(self._target)
        return self._packed

    @cached_property
    def documents(self) -> Packed:
        """Documents of the store, all of one moment.

        Raises
        ------
        NotAStore
            There are none.
        CorruptStore
            They have other bytes than were written.
        """
        try:
            return Packed(InMemory(DOCUMENTS, self._source.read(DOCUMENTS)))
        except FileNotFoundError as error:
            raise NotAStore(f"{self} holds no results") from error

    @cached_property
    def digest(self) -> bytes:
        """Begins the checksums of all files but the documents, which hold it."""
        digest = digest_in(self.attributes) if self._digest is None else self._digest
        return digest.encode()

    @property
    def attributes(self) -> dict[str, Any]:
        """Attributes of the root, by which the store says what it holds; errors of `documents`."""
        found: dict[str, Any] = json.loads(self.documents.read("zarr.json"))["attributes"]
        return found

    def write_other(self, path: str, pieces: Iterable[bytes]) -> None:
        """Write a file that is no part of the sealed store; durable on return."""
        self._sync_folders()
        durable.write(self.folder / path, pieces)

    def parts(self) -> list[str]:
        """Name what is in the folder `PARTS`."""
        return [name.removeprefix(f"{PARTS}/") for name in self._source.names(PARTS)]

    def part(self, name: str) -> bytes:
        """Read a file of the folder `PARTS`; FileNotFoundError if it is not there."""
        return self._source.read(f"{PARTS}/{name}")

    def stamp(self, name: str) -> Hashable | None:
        """Return what changes with a file of the folder `PARTS`; None: that cannot be told."""
        return self._source.stamp(f"{PARTS}/{name}")

    def _ask(self, key: str, question: Callable[[Packed], Found]) -> Found:
        """Ask the packed file that holds a key."""
        if key in self.documents.entries:
            return question(self.documents)
        try:
            return question(self._pack(key))
        except (FileNotFoundError, LostObject):
            sealed = self.sealed()
            if sealed is None:
                raise
        return question(sealed)

    def _pack(self, key: str) -> Packed:
        name = _name(key)
        found = self._source.object(f"{ROWS}/{name}")
        version = found.version()  # what is remembered of it is true of this one alone
        if version is None:
            raise FileNotFoundError(f"{self} has no {key!r}")
        known = self._packs.get(name)
        if known is None or known[0] != version:
            try:
                packed = Packed(found, self.digest)
            except NotAStore as error:  # removed meanwhile
                raise FileNotFoundError(str(error)) from error
            if any(_name(one) != name for one in packed):
                raise CorruptStore(f"{found} holds chunks of another index")
            known = self._packs[name] = version, packed
        return known[1]

    def _sync_folders(self) -> None:
        """Make the names of the folders durable, before the first file is."""
        if not self._synced:
            durable.sync(self.folder)
            durable.sync(self.folder.parent)
            self._synced = True

    def _path(self, key: str) -> Path:
        return self.folder / self.file_of(key)


def make_folders(folder: Path) -> None:
    """Make the folders of a store's files, which are there as soon as its documents are."""
    for name in (ROWS, PARTS):
        _make(folder / name)


def _make(folder: Path) -> None:
    """Make a folder and those above it; one above may be empty, and removed meanwhile."""
    for _ in range(_PATIENCE):
        with suppress(FileNotFoundError):
            return folder.mkdir(parents=True, exist_ok=True)
    return folder.mkdir(parents=True)


def digest_in(attributes: Mapping[str, Any]) -> str:
    """Return the digest of what is computed by a root's attributes; of a study, of its layout."""
    return str(attributes.get("layout") or attributes.get("digest") or "")


def indices_in_file(key: str) -> int:
    """Count the chunk indices, one behind the other, that share a file with that of a key."""
    return _TOGETHER.get(key.partition("/")[0], 1)


def _name(key: str) -> str:
    """Name the packed file of a chunk by its group and its index in the grid of chunks."""
    array, _, index = key.rpartition("/c/")
    group = array.rpartition("/")[0] or "history"
    if (count := indices_in_file(key)) > 1:
        first = int(index.partition("/")[0]) // count * count
        index = f"{first}-{first + count - 1}"
    return f"{group}-{index}.zip".replace("/", "-")
