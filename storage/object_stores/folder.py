"""A folder of a file system that all processes of the platform share: objects are its files."""

import errno
import os
from collections.abc import Iterable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from glob import escape
from math import inf
from pathlib import Path
from typing import Final

from jointplay.storage import durable

_NOT_LINKABLE: Final = frozenset({errno.EXDEV, errno.EPERM, errno.EMLINK, errno.EOPNOTSUPP})


@dataclass(frozen=True)
class Folder:
    """See `storage.object_stores.ObjectStore`; made when something is put there."""

    root: str

    @property
    def largest(self) -> float:
        """Any number: the disk is what limits it."""
        return inf

    def put(self, key: str, pieces: Iterable[bytes]) -> None:
        """Write a partial file, sync it, and link it to its name, which fails if it is taken."""
        path = self._path(key)
        if path.exists():
            raise _taken(path)
        durable.make_folder(path.parent)
        partial = durable.draft(path, pieces)
        try:
            _name(partial, path)
        finally:
            partial.unlink(missing_ok=True)
        durable.sync(path.parent)

    def replace(self, key: str, pieces: Iterable[bytes]) -> None:
        """Write a partial file, sync it, and give it the name."""
        path = self._path(key)
        durable.make_folder(path.parent)
        durable.write(path, pieces)

    def size(self, key: str) -> int:
        """Look the file up."""
        try:
            return self._path(key).stat().st_size
        except NotADirectoryError as error:
            raise FileNotFoundError(str(error)) from error

    def version(self, key: str) -> str | None:
        """Look the file up; its times are those of its content and of its inode."""
        try:
            found = os.stat(f"{self.root}/{key}")
        except (FileNotFoundError, NotADirectoryError):
            return None
        return f"{found.st_ino}-{found.st_size}-{found.st_mtime_ns}-{found.st_ctime_ns}"

    def read(self, key: str, start: int, stop: int) -> bytes:
        """Read with one open and, but for files on odd systems, one read."""
        descriptor = os.open(f"{self.root}/{key}", os.O_RDONLY)
        try:
            pieces = []
            while start < stop and (piece := os.pread(descriptor, stop - start, start)):
                pieces.append(piece)
                start += len(piece)
        finally:
            os.close(descriptor)
        return pieces[0] if len(pieces) == 1 else b"".join(pieces)

    def entity_tag(self, key: str) -> str | None:
        """Return nothing: no server answers for a folder."""
        return None

    def list(self, prefix: str) -> Iterator[str]:
        """Walk the folder that the prefix ends in."""
        return (key for key in self._files(prefix) if not key.endswith(durable.PARTIAL))

    def cut_off(self, prefix: str) -> Iterator[str]:
        """Walk the folder that the prefix ends in."""
        return (key for key in self._files(prefix) if key.endswith(durable.PARTIAL))

    def remove(self, prefix: str) -> None:
        """Delete the files; folders stay, other jobs may be about to use them."""
        for key in list(self._files(prefix)):
            self._path(key).unlink(missing_ok=True)

    def adopt(self, key: str, lost: str) -> bool:
        """Link the file to a second name, or copy it where the file system cannot."""
        source, path = self._path(lost), self._path(key)
        if not source.exists():
            return False
        durable.make_folder(path.parent)
        with suppress(FileExistsError):
            try:
                os.link(source, path)
            except OSError as error:
                if error.errno not in _NOT_LINKABLE:
                    raise
                with source.open("rb") as file:
                    self.put(key, iter(lambda: file.read(2**20), b""))
        durable.sync(path.parent)
        return True

    def link(self, key: str, endpoint: str, seconds: float) -> str | None:
        """Return nothing: no server answers for a folder."""
        return None

    def link_to_put(self, key: str, endpoint: str, seconds: float, size: int) -> str | None:
        """Return nothing: no server answers for a folder."""
        return None

    def _files(self, prefix: str) -> Iterator[str]:
        folder, _, begin = prefix.rpartition("/")
        for path in sorted((Path(self.root) / folder).glob(f"{escape(begin)}*")):
            for found in path.rglob("*") if path.is_dir() else (path,):
                if found.is_file():
                    yield found.relative_to(self.root).as_posix()

    def _path(self, key: str) -> Path:
        return Path(self.root) / key


def _name(partial: Path, path: Path) -> None:
    """Give a partial file its name unless that is taken."""
    try:
        os.link(partial, path)
    except FileExistsError:
        raise _taken(path) from None
    except OSError as error:
        if error.errno not in _NOT_LINKABLE:
            raise
        if path.exists():  # such a file system cannot name it exclusively
            raise _taken(path) from None
        os.replace(partial, path)


def _taken(path: Path) -> FileExistsError:
    return FileExistsError(errno.EEXIST, "results are written once", str(path))
