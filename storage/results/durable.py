"""Files of a store that outlive a power cut, each with its size and checksum."""

import ctypes
import errno
import os
import shutil
from contextlib import suppress
from dataclasses import dataclass, field
from hashlib import sha256
from pathlib import Path
from typing import Final

PARTIAL: Final = ".partial"
MANY: Final = 16
"""From this many files on, writing back the whole file system is faster than one by one."""
_NEW_FILE: Final = os.O_WRONLY | os.O_CREAT | os.O_TRUNC
_NOT_LINKABLE: Final = frozenset({errno.EXDEV, errno.EPERM, errno.EMLINK, errno.EOPNOTSUPP})


@dataclass(frozen=True)
class Record:
    """Size [bytes] and SHA-256 of one file."""

    size: int
    digest: str


@dataclass
class DurableFolder:
    """Writes whole files below a folder, many at a time.

    A file appears under its name only when all of it is on the disk. `records` holds size and
    checksum of every file written, by key (path below the folder, with slashes). Several writers
    of one folder need a `partial` each, what a file's name ends with while it is written.
    """

    root: Path
    partial: str = PARTIAL
    records: dict[str, Record] = field(default_factory=dict)
    _partial: dict[str, None] = field(default_factory=dict)  # in order, each once
    _folders: set[str] = field(default_factory=set)
    _unsynced: set[str] = field(default_factory=set)

    def write(self, key: str, content: bytes) -> None:
        """Write one file, to appear with the next `commit`; its folder is made if need be."""
        self._put(key, content)
        self._partial[key] = None
        self.records[key] = Record(len(content), sha256(content).hexdigest())

    def commit(self) -> None:
        """Make everything durable that was written since the last commit.

        All files first, then all their names.
        """
        sync_all([f"{self.root}/{key}{self.partial}" for key in self._partial])
        for key in self._partial:
            self._appear(key)
        self._partial.clear()
        sync_all([f"{self.root}/{folder}".rstrip("/") for folder in sorted(self._unsynced)])
        self._unsynced.clear()

    def discard(self) -> None:
        """Remove what was written since the last commit."""
        for key in self._partial:
            Path(f"{self.root}/{key}{self.partial}").unlink(missing_ok=True)
        self._partial.clear()

    def draft(self, key: str, content: bytes) -> None:
        """Write one file that readers see whole, but that a power cut may take away."""
        self._put(key, content)
        self._appear(key)

    def adopt(self, key: str, source: Path) -> None:
        """Take a finished file over from `source`: a second name for it, or else a copy."""
        path = self.root / key
        self._make_folder(key)
        try:
            os.link(source, path)
        except OSError as error:
            if error.errno not in _NOT_LINKABLE:
                raise
            partial = f"{path}{self.partial}"
            shutil.copyfile(source, partial)
            sync(partial)
            os.replace(partial, path)

    def record(self, key: str) -> Record:
        """Size and checksum of a file; read from the disk where it was not written here."""
        known = self.records.get(key)
        if known is None:
            known = self.records[key] = measure(self.root / key)
        return known

    def _put(self, key: str, content: bytes) -> None:
        self._make_folder(key)
        descriptor = os.open(f"{self.root}/{key}{self.partial}", _NEW_FILE, 0o666)
        try:
            _write_all(descriptor, content)
        finally:
            os.close(descriptor)

    def _appear(self, key: str) -> None:
        path = f"{self.root}/{key}"
        os.replace(path + self.partial, path)

    def _make_folder(self, key: str) -> None:
        """Make the folder of a file; a new folder's name must become durable as well."""
        folder = key.rpartition("/")[0]
        self._unsynced.add(folder)
        missing = []
        while folder and folder not in self._folders:
            missing.append(folder)
            folder = folder.rpartition("/")[0]
            self._unsynced.add(folder)
        for name in reversed(missing):
            with suppress(FileExistsError):
                os.mkdir(f"{self.root}/{name}")
            self._folders.add(name)


def measure(path: Path) -> Record:
    """Size and checksum of a file on the disk, in bounded memory."""
    digest = sha256()
    size = 0
    with path.open("rb") as file:
        while block := file.read(2**20):
            digest.update(block)
            size += len(block)
    return Record(size, digest.hexdigest())


def _write_all(descriptor: int, content: bytes) -> None:
    view = memoryview(content)
    while view:
        view = view[os.write(descriptor, view) :]


def sync_all(paths: list[str]) -> None:
    """Wait until files, or the names in folders, of one file system are on the disk.

    Many of them at once by one call for the whole file system, where the system has it: a store
    of 95 channels else waits a thousand times.
    """
    if len(paths) >= MANY and sync_file_system(paths[0]):
        return
    for path in paths:
        sync(path)


def sync_file_system(path: str) -> bool:
    """Write back everything of the file system that holds a path; whether that was possible."""
    call = getattr(ctypes.CDLL(None), "syncfs", None)  # Linux has it
    if call is None:
        return False
    descriptor = os.open(path, os.O_RDONLY)
    try:
        return bool(call(descriptor) == 0)
    finally:
        os.close(descriptor)


def sync(path: str | Path) -> None:
    """Wait until the content of a file, or the names in a folder, are on the disk."""
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
