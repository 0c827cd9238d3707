"""Files of a store that outlive a power cut, each with its size and checksum."""

import errno
import os
import shutil
from dataclasses import dataclass, field
from hashlib import sha256
from pathlib import Path
from typing import Final

PARTIAL: Final = ".partial"
_NOT_LINKABLE: Final = frozenset({errno.EXDEV, errno.EPERM, errno.EMLINK, errno.EOPNOTSUPP})


@dataclass(frozen=True)
class Record:
    """Size [bytes] and SHA-256 of one file."""

    size: int
    digest: str


@dataclass
class DurableFolder:
    """Writes whole files below a folder; `commit` makes everything written so far durable.

    A file appears under its name only when all of it is on the disk. `records` holds size and
    checksum of every file written, by key (path below the folder, with slashes).
    """

    root: Path
    records: dict[str, Record] = field(default_factory=dict)
    _unsynced: set[str] = field(default_factory=set)

    def write(self, key: str, content: bytes) -> None:
        """Write one file, fsync it and move it to its name; its folder is made if need be."""
        path = f"{self.root}/{key}"
        self._note_folders(key)
        try:
            descriptor = _create(path + PARTIAL)
        except FileNotFoundError:
            os.makedirs(os.path.dirname(path))
            descriptor = _create(path + PARTIAL)
        try:
            _write_all(descriptor, content)
            os.fsync(descriptor)
        finally:
            os.close(descriptor)
        os.replace(path + PARTIAL, path)
        self.records[key] = Record(len(content), sha256(content).hexdigest())

    def adopt(self, key: str, source: Path) -> None:
        """Take a finished file over from `source`: a second name for it, or else a copy."""
        path = self.root / key
        self._note_folders(key)
        path.parent.mkdir(parents=True, exist_ok=True)
        try:
            os.link(source, path)
        except OSError as error:
            if error.errno not in _NOT_LINKABLE:
                raise
            partial = f"{path}{PARTIAL}"
            shutil.copyfile(source, partial)
            _sync(partial)
            os.replace(partial, path)

    def commit(self) -> None:
        """Make the names of everything written since the last commit durable."""
        for folder in sorted(self._unsynced):
            _sync(f"{self.root}/{folder}" if folder else str(self.root))
        self._unsynced.clear()

    def record(self, key: str) -> Record:
        """Size and checksum of a file; read from the disk where it was not written here."""
        known = self.records.get(key)
        if known is None:
            known = self.records[key] = measure(self.root / key)
        return known

    def _note_folders(self, key: str) -> None:
        while key:
            key = key.rpartition("/")[0]
            self._unsynced.add(key)


def measure(path: Path) -> Record:
    """Size and checksum of a file on the disk, in bounded memory."""
    digest = sha256()
    size = 0
    with path.open("rb") as file:
        while block := file.read(2**20):
            digest.update(block)
            size += len(block)
    return Record(size, digest.hexdigest())


def _create(path: str) -> int:
    return os.open(path, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o666)


def _write_all(descriptor: int, content: bytes) -> None:
    view = memoryview(content)
    while view:
        view = view[os.write(descriptor, view) :]


def _sync(path: str) -> None:
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
