"""Files that an attempt at a block reads and writes, by names that a worker elsewhere may use.

What a job needs while it runs has its path below the job's folder, such as
``a1/rows/steps-0-0.zip`` or ``study/parts/00003-a1``; sealed results are ``sealed/1``, by the
attempt, or ``sealed/study``.
"""

import re
import secrets
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from hashlib import sha256
from typing import Final

from jointplay.storage import durable
from jointplay.storage.catalogue.records import Block
from jointplay.storage.object_stores import StoredObject
from jointplay.storage.packed.running import DOCUMENTS, ROWS, make_folders
from jointplay.storage.running_files.folder import InFolder
from jointplay.storage.running_files.objects import InObjectStore
from jointplay.storage.settings import Settings

_NAME: Final = re.compile(r"(?:(?!\.{1,2}/)[A-Za-z0-9._-]{1,80}/){0,2}(?!\.)[A-Za-z0-9._-]{1,120}")
SEALED: Final = "sealed/"
STUDY: Final = "study"
"""Folder of a study, whose blocks leave files that are not sealed yet; name of its sealed results.
"""
_PIECE: Final = 2**20
_PART: Final = 2**23
"""Bytes that are read from an object store at once, where each reading is a request."""
LEAST: Final = 4096
"""Bytes that a file of an attempt counts at least: names and places of files take room, too."""
_DROPS: Final = "drops"
"""Where workers put what is not found right yet, below what else a running job needs."""


def is_written_once(name: str) -> bool:
    """Whether a file is never replaced: sealed results, and rows."""
    return name.startswith(SEALED) or f"/{ROWS}/" in name


class AttemptFiles:
    """Files of one attempt, in a data folder and in the object store.

    Parameters
    ----------
    settings
        Where these are.
    block
        As the attempt claimed it.
    """

    def __init__(self, settings: Settings, block: Block) -> None:
        self._settings = settings
        self._block = block
        self.running = settings.running_files(block.job)

    def checked(self, name: str) -> str:
        """Return the name of a file of the running job; ValueError if it is none of one."""
        if not _NAME.fullmatch(name) or name.startswith(SEALED) or name.endswith(durable.PARTIAL):
            raise ValueError(f"{name!r} is no file of a running job")
        return name

    def sealed(self, name: str) -> StoredObject | None:
        """Return the object of sealed results that a name means; None for other files.

        Raises
        ------
        ValueError
            Its attempt is none that there can be.
        """
        if not name.startswith(SEALED):
            return None
        which = name.removeprefix(SEALED)
        if which == STUDY:
            return self._settings.sealed_study(self._block.job)
        if not re.fullmatch(r"[1-9]\d{0,8}", which) or int(which) > self._block.attempt:
            raise ValueError(f"{name!r} is no result of this attempt or of one before")
        return self._settings.sealed_run(self._block.job, int(which))

    def own_sealed(self) -> Iterator[str]:
        """Name the sealed results of this attempt that are there."""
        for name in (f"{SEALED}{self._block.attempt}", f"{SEALED}{STUDY}"):
            found = self.sealed(name)
            if found is not None and found.exists():
                yield name

    def needed(self) -> Iterator[tuple[str, int]]:
        """Give name and bytes of what the attempt builds on; nothing that it may do without.

        A run needs what earlier attempts left, and what they sealed; so does one of the same number
        whose claim the catalogue has lost. A block of a study needs the documents of its store,
        and, if it was begun, what is there; the block that seals, all.
        """
        block = self._block
        for attempt in range(1, block.attempt + 1):
            lost = self.sealed(f"{SEALED}{attempt}")
            if lost is not None and lost.exists():
                yield f"{SEALED}{attempt}", lost.size()
        if (block.attempt, block.index, block.count) == (1, 0, 1):
            return  # a run that begins, or a study of one point
        for name in self.running.names():
            with suppress(FileNotFoundError):  # replaced, or removed meanwhile
                if self._is_needed(name):
                    yield name, self.running.size(name)

    def read(self, name: str) -> Iterator[bytes]:
        """Give a file in pieces; FileNotFoundError if it is not there."""
        sealed = self.sealed(name)
        if sealed is None:
            yield self.running.read(self.checked(name))
            return
        size = sealed.size()
        for start in range(0, size, _PIECE):
            yield sealed.read(start, min(start + _PIECE, size))

    def _is_needed(self, name: str) -> bool:
        if self._block.count == 0 or name == f"{STUDY}/documents.zip":
            return True
        if self._block.attempt == 1:
            return False
        part = name.removeprefix(f"{STUDY}/parts/")
        return part == name or part.partition("-")[0] == f"{self._block.index:05d}"

    def put(self, name: str, pieces: Iterable[bytes]) -> None:
        """Store a file whole, in place of one that may be there; sealed results stay as they are.

        Durable on return.
        """
        sealed = self.sealed(name)
        if sealed is None:
            self.running.put(self.checked(name), pieces)
            if name.endswith(f"/{DOCUMENTS}") and isinstance(self.running, InFolder):
                make_folders((self.running.path / name).parent)  # a block goes on there
            return
        with suppress(FileExistsError):  # the answer to an earlier try was lost
            sealed.put(pieces)

    def drop(self, name: str, digest: str) -> StoredObject | None:
        """Return the object that a worker may put for a file, by the SHA-256 of its bytes.

        It is no file of the job until `take` was called. None for files that are replaced or
        appended to, and where files of running jobs are in no object store.

        Raises
        ------
        ValueError
            There is no file of this name.
        """
        if not isinstance(self.running, InObjectStore) or self._target(name) is None:
            return None
        return StoredObject(self.running.object_store, f"{self._drops()}{digest}")

    def stored(self, is_own: Callable[[str], bool]) -> int:
        """Return the bytes of files of the attempt, by their names, and of what it dropped.

        A file counts `LEAST` at least.
        """
        found = 0
        for name in [*filter(is_own, self.running.names()), *self.own_sealed()]:
            with suppress(FileNotFoundError):
                sealed = self.sealed(name)
                size = self.running.size(name) if sealed is None else sealed.size()
                found += max(size, LEAST)
        if isinstance(self.running, InObjectStore):
            for key in self.running.object_store.list(self._drops()):
                with suppress(FileNotFoundError):
                    found += self.running.object_store.size(key)
        return found

    def _drops(self) -> str:
        """Begin the keys of what was dropped; of files in a folder nothing can be."""
        prefix = self.running.prefix if isinstance(self.running, InObjectStore) else ""
        return f"{prefix}/{_DROPS}/{self._block.index}-a{self._block.attempt}-"

    @contextmanager
    def copied(self, name: str, digest: str, size: int) -> Iterator[StoredObject]:
        """Give a copy of what was dropped for a file, which the worker cannot put again.

        What was dropped is removed once the copy was made use of without an error.

        Raises
        ------
        FileNotFoundError
            Nothing was dropped.
        ValueError
            It has another size, or can be no such file.
        """
        dropped = self.drop(name, digest)
        if dropped is None or dropped.size() != size:
            raise ValueError(f"{name!r} has other bytes than were told")
        key = f"{self._drops()}copy-{secrets.token_hex(8)}"
        copy = StoredObject(dropped.object_store, key)
        dropped.object_store.adopt(key, dropped.key)
        try:
            yield copy
            dropped.object_store.remove(dropped.key)
        finally:
            copy.object_store.remove(key)

    def take(self, name: str, digest: str, size: int, md5: str) -> None:
        """Make a file of what was dropped for it, once its bytes were found right, and remove that.

        They are where the store says that they have this MD5; else all of them are read. Either
        finds a fault of the way; the worker itself may put what it likes.

        Raises
        ------
        FileNotFoundError
            Nothing was dropped.
        ValueError
            It has other bytes, or can be no such file.
        """
        dropped, target = self.drop(name, digest), self._target(name)
        if dropped is None or target is None:
            raise ValueError(f"{name!r} is no file that can be dropped")
        if not target.exists():
            if dropped.size() != size or (
                dropped.object_store.entity_tag(dropped.key) != md5
                and _sha256(dropped, size) != digest
            ):
                raise ValueError(f"{name!r} has other bytes than were told")
            target.object_store.adopt(target.key, dropped.key)
        dropped.object_store.remove(dropped.key)

    def _target(self, name: str) -> StoredObject | None:
        """Return the object of a file that is written once; None for other files."""
        sealed = self.sealed(name)
        if sealed is not None:
            return sealed
        return self.running.object(self.checked(name)) if is_written_once(name) else None

    def append(self, name: str, offset: int, pieces: Iterable[bytes]) -> None:
        """See `RunningFiles.append`."""
        self.running.append(self.checked(name), offset, pieces)

    def adopt(self, name: str, source: str) -> bool:
        """See `RunningFiles.adopt`."""
        return self.running.adopt(self.checked(name), self.checked(source))

    def remove(self, name: str) -> None:
        """Remove a file of the running job, if it is there."""
        self.running.remove(self.checked(name))


def _sha256(stored: StoredObject, size: int) -> str:
    found = sha256()
    for start in range(0, size, _PART):
        found.update(stored.read(start, min(start + _PART, size)))
    return found.hexdigest()
