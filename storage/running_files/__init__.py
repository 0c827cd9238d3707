"""Files of a job that runs: in the data folder, or in the object store of results.

A member has one file. What it must do is said by `RunningFiles`, and tested by
`tests/storage/running_files`. Names have slashes between them, such as ``a1/rows/history-0.zip``.
"""

from collections.abc import Hashable, Iterable, Iterator
from typing import Protocol, Self

from jointplay.storage.object_stores import StoredObject


class RunningFiles(Protocol):
    """Files below one folder: all of a job, or those of one store of it."""

    @property
    def name(self) -> str:
        """Name of the folder."""
        ...

    def below(self, name: str) -> Self:
        """Return the files of a folder in this one."""
        ...

    def names(self, folder: str = "") -> Iterator[str]:
        """Yield the names of all files, or of those in a folder, in order; none is half written."""
        ...

    def has(self, name: str) -> bool:
        """Tell whether a file is there, or was when the files were last listed."""
        ...

    def size(self, name: str) -> int:
        """Return the bytes of a file; FileNotFoundError if it is not there."""
        ...

    def stamp(self, name: str) -> Hashable | None:
        """Return what changes whenever a file does, and no other file has.

        None: that cannot be told, or it is not there.
        """
        ...

    def read(self, name: str) -> bytes:
        """Return a whole file; FileNotFoundError if it is not there."""
        ...

    def object(self, name: str) -> StoredObject:
        """Return a file that is written once, to be read by ranges; need not be there."""
        ...

    def put(self, name: str, pieces: Iterable[bytes]) -> None:
        """Store a file whole, in place of one that may be there; durable on return."""
        ...

    def append(self, name: str, offset: int, pieces: Iterable[bytes]) -> None:
        """Go on with a file from an offset, which ends with these bytes; durable on return.

        Raises
        ------
        ValueError
            The file is shorter.
        FileNotFoundError
            It is not there.
        """
        ...

    def adopt(self, name: str, source: str) -> bool:
        """Give a file that is written once a second name. Returns whether there was one."""
        ...

    def remove(self, name: str) -> None:
        """Remove a file, if it is there."""
        ...

    def clear(self) -> None:
        """Remove all files; OSError if they cannot be."""
        ...
