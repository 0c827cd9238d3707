"""Files of a running job in a folder, which all who need them share."""

import os
import shutil
from collections.abc import Hashable, Iterable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Self

from jointplay.storage import durable
from jointplay.storage.object_stores import StoredObject
from jointplay.storage.object_stores.folder import Folder


@dataclass(frozen=True)
class InFolder:
    """See `storage.running_files.RunningFiles`; the folder need not be there."""

    path: Path

    @property
    def name(self) -> str:
        """Name of the folder."""
        return self.path.name

    def __str__(self) -> str:
        return f"{self.path.parent.name}/{self.path.name}"

    def below(self, name: str) -> Self:
        """Return the files of a folder in this one."""
        return type(self)(self.path / name)

    def names(self, folder: str = "") -> Iterator[str]:
        """Walk the folder."""
        found: list[str] = []
        for parent, _, files in os.walk(self.path / folder, onerror=_raise_unless_gone):
            below = os.path.relpath(parent, self.path)
            found += (os.path.normpath(os.path.join(below, name)) for name in files)
        for name in sorted(found, key=lambda name: name.split("/")):
            if not name.endswith(durable.PARTIAL):
                yield name

    def has(self, name: str) -> bool:
        """Look the file up."""
        return self.object(name).exists()

    def size(self, name: str) -> int:
        """Look the file up."""
        return (self.path / name).stat().st_size

    def stamp(self, name: str) -> Hashable | None:
        """Look the file up."""
        path = self.path / name
        try:
            found = path.stat()
        except FileNotFoundError:
            return None
        return str(path.absolute()), found.st_ino, found.st_mtime_ns, found.st_size

    def read(self, name: str) -> bytes:
        """Read the file."""
        return (self.path / name).read_bytes()

    def object(self, name: str) -> StoredObject:
        """Name the file."""
        return StoredObject(Folder(str(self.path)), name)

    def put(self, name: str, pieces: Iterable[bytes]) -> None:
        """Write a partial file and give it the name."""
        path = self.path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        durable.write(path, pieces)

    def append(self, name: str, offset: int, pieces: Iterable[bytes]) -> None:
        """Write into the file, and cut it where these bytes end."""
        with (self.path / name).open("r+b") as file:
            if file.seek(0, os.SEEK_END) < offset:
                raise ValueError(f"{name!r} has fewer than {offset} bytes")
            file.seek(offset)
            file.writelines(pieces)
            file.truncate()
            file.flush()
            os.fsync(file.fileno())

    def adopt(self, name: str, source: str) -> bool:
        """Link the file to a second name."""
        found = self.object(name)
        return found.object_store.adopt(found.key, source)

    def remove(self, name: str) -> None:
        """Delete the file."""
        (self.path / name).unlink(missing_ok=True)

    def clear(self) -> None:
        """Delete the folder, and the one above if it is empty."""
        shutil.rmtree(self.path, ignore_errors=True)  # others may do so, too
        if self.path.exists():
            shutil.rmtree(self.path)
        with suppress(OSError):  # other jobs are in it
            self.path.parent.rmdir()


def _raise_unless_gone(error: OSError) -> None:
    """Raise what keeps names from being read: whoever misses one may take the file for removed."""
    if not isinstance(error, FileNotFoundError | NotADirectoryError | PermissionError):
        raise error
