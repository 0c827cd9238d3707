"""Files that an attempt at a block reads and writes, by names that a worker elsewhere may use.

What a job needs while it runs has its path below the job's folder, such as
``a1/rows/steps-0-0.zip`` or ``study/parts/00003-a1``; sealed results are ``sealed/1``, by the
attempt, or ``sealed/study``.
"""

import os
import re
from collections.abc import Iterable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import Final

from jointplay.storage import durable
from jointplay.storage.catalogue.records import Block
from jointplay.storage.packed.running import DOCUMENTS, make_folders
from jointplay.storage.places import StoredObject
from jointplay.storage.settings import Settings

_NAME: Final = re.compile(r"(?:(?!\.{1,2}/)[A-Za-z0-9._-]{1,80}/){0,2}(?!\.)[A-Za-z0-9._-]{1,120}")
_SEALED: Final = "sealed/"
_STUDY: Final = "study"


class AttemptFiles:
    """Files of one attempt, in a data folder and the place of its results.

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
        self.folder = settings.running_folder(block.job)

    def path(self, name: str) -> Path:
        """Return the path of a file of the running job; ValueError if the name is none of one."""
        if not _NAME.fullmatch(name) or name.startswith(_SEALED) or name.endswith(durable.PARTIAL):
            raise ValueError(f"{name!r} is no file of a running job")
        return self.folder / name

    def sealed(self, name: str) -> StoredObject | None:
        """Return the object of sealed results that a name means; None for other files.

        Raises
        ------
        ValueError
            Its attempt is none that there can be.
        """
        if not name.startswith(_SEALED):
            return None
        which = name.removeprefix(_SEALED)
        if which == _STUDY:
            return self._settings.sealed_study(self._block.job)
        if not re.fullmatch(r"[1-9]\d{0,8}", which) or int(which) > self._block.attempt:
            raise ValueError(f"{name!r} is no result of this attempt or of one before")
        return self._settings.sealed_run(self._block.job, int(which))

    def own_sealed(self) -> Iterator[str]:
        """Name the sealed results of this attempt that are there."""
        for name in (f"{_SEALED}{self._block.attempt}", f"{_SEALED}{_STUDY}"):
            found = self.sealed(name)
            if found is not None and found.exists():
                yield name

    def needed(self) -> Iterator[tuple[str, int]]:
        """Give name and bytes of what the attempt builds on; nothing that it may do without.

        A run needs what earlier attempts left, and what they sealed. A block of a study needs the
        documents of its store, and, if it was begun, what is there; the block that seals, all.
        """
        block = self._block
        for attempt in range(1, block.attempt):
            lost = self.sealed(f"{_SEALED}{attempt}")
            if lost is not None and lost.exists():
                yield f"{_SEALED}{attempt}", lost.size()
        for path in sorted(self.folder.rglob("*")):
            name = path.relative_to(self.folder).as_posix()
            with suppress(FileNotFoundError):  # replaced, or removed meanwhile
                if path.is_file() and self._is_needed(name):
                    yield name, path.stat().st_size

    def _is_needed(self, name: str) -> bool:
        if name.endswith(durable.PARTIAL):
            return False
        if self._block.count == 0 or name == f"{_STUDY}/documents.zip":
            return True
        if self._block.attempt == 1:
            return False
        part = name.removeprefix(f"{_STUDY}/parts/")
        return part == name or part.partition("-")[0] == f"{self._block.index:05d}"

    def put(self, name: str, pieces: Iterable[bytes]) -> None:
        """Store a file whole, in place of one that may be there; sealed results stay as they are.

        Durable on return.
        """
        sealed = self.sealed(name)
        if sealed is None:
            path = self.path(name)
            path.parent.mkdir(parents=True, exist_ok=True)
            if path.name == DOCUMENTS:
                make_folders(path.parent)
            durable.write(path, pieces)
            return
        with suppress(FileExistsError):  # the answer to an earlier try was lost
            sealed.put(pieces)

    def remove(self, name: str) -> None:
        """Remove a file of the running job, if it is there."""
        self.path(name).unlink(missing_ok=True)

    def append(self, name: str, offset: int, pieces: Iterable[bytes]) -> None:
        """Go on with a file from an offset, which ends with these bytes; durable on return.

        Raises
        ------
        ValueError
            The file is shorter.
        FileNotFoundError
            It is not there.
        """
        with self.path(name).open("r+b") as file:
            if file.seek(0, os.SEEK_END) < offset:
                raise ValueError(f"{name!r} has fewer than {offset} bytes")
            file.seek(offset)
            file.writelines(pieces)
            file.truncate()
            file.flush()
            os.fsync(file.fileno())
