"""Files of one attempt on this machine, and those elsewhere that they are copies of."""

import os
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from typing import Final, NamedTuple, Protocol, Self

from jointplay.storage.attempt_files import AttemptFiles
from jointplay.storage.catalogue.errors import CatalogueError
from jointplay.storage.catalogue.records import Block
from jointplay.storage.object_stores.folder import Folder
from jointplay.storage.object_stores.taken import heard
from jointplay.storage.packed.running import DOCUMENTS, PARTS, ROWS
from jointplay.storage.settings import Settings
from jointplay.worker.advance import Advance, noted

_PIECE: Final = 2**20
_LOOK: Final = 0.1
"""Seconds after which it is looked for rows that are whole ..."""
_RARELY: Final = 50
"""... and at least so many times as long as the last look took: the processor is to compute."""
_LARGE: Final = 2**20
"""Bytes of rows that are sent at once; of fewer a run may be over before they are needed."""
_AT_ONCE: Final = 4
"""Files that are fetched at a time."""
_Version = tuple[int, int, int]
"""Inode, bytes and time of a file as it was sent."""


class Elsewhere(Protocol):
    """Files of the attempt where others find them; names are those of `AttemptFiles`."""

    def needed(self) -> Iterable[tuple[str, int]]:
        """Give name and bytes of what the attempt builds on."""
        ...

    def read(self, name: str) -> Iterator[bytes]:
        """Give a file in pieces; FileNotFoundError if it is gone."""
        ...

    def put(self, name: str, pieces: Iterable[bytes]) -> None:
        """Store a file whole."""
        ...

    def append(self, name: str, offset: int, pieces: Iterable[bytes]) -> None:
        """Go on with a file from an offset."""
        ...

    def adopt(self, name: str, source: str) -> bool:
        """Give a file a second name. Returns whether that can be done."""
        ...

    def remove(self, name: str) -> None:
        """Remove a file."""
        ...


class Taken(NamedTuple):
    """Files as they were at one moment, open until they are sent or given up."""

    files: tuple[tuple[str, "_File"], ...]  # in the order in which they are to be sent
    gone: tuple[str, ...]
    opened: ExitStack


class Scratch:
    """Brings the files of an attempt here, and what changes in them to where others find them.

    Parameters
    ----------
    settings
        With a data folder of its own, which is empty.
    advance
        Hears of each piece that is sent.
    """

    def __init__(
        self, elsewhere: Elsewhere, settings: Settings, block: Block, advance: Advance
    ) -> None:
        self._elsewhere = elsewhere
        self._advance = advance
        self._files = AttemptFiles(settings, block)
        self._folder = settings.running_folder(block.job)
        self._sends = block.count > 0
        """A block that seals a study sends nothing else: other files are those of its blocks."""
        self._heartbeat = settings.heartbeat
        self._next_beat = 0.0
        self._sent: dict[str, _Version] = {}
        self._sending = threading.Lock()

    def fetch(self, beat: Callable[[], object]) -> None:
        """Get what the attempt builds on; `beat` holds the block meanwhile, from several threads.

        The block that seals a study needs many small files, which come a few at a time.
        """
        self._next_beat = time.monotonic() + self._heartbeat
        with ThreadPoolExecutor(_AT_ONCE, "fetching") as pool:
            for _ in pool.map(lambda file: self._fetch(file[0], beat), self._elsewhere.needed()):
                pass

    def _fetch(self, name: str, beat: Callable[[], object]) -> None:
        sealed = self._files.sealed(name)
        if sealed is not None and sealed.exists():
            return
        try:
            self._files.put(name, self._beating(name, beat))
        except FileNotFoundError:  # replaced by the last one of its block, or removed
            return
        if sealed is None:
            self._sent[name] = _version(self._folder / name)

    def _beating(self, name: str, beat: Callable[[], object]) -> Iterator[bytes]:
        for piece in self._elsewhere.read(name):
            if time.monotonic() > self._next_beat:
                beat()
                self._next_beat = time.monotonic() + self._heartbeat
            yield piece

    @property
    def used(self) -> bool:
        """Whether there is anything elsewhere."""
        return bool(self._sent)

    def take(self, folder: str = "") -> Taken:
        """Take all files, or those in a folder, that are not as they were sent.

        Files that build on others come last.
        """
        if not self._sends:
            return Taken((), (), ExitStack())
        there = {*self._files.running.names(folder)}
        gone = (one for one in [*self._sent] if one.startswith(folder) and one not in there)
        paths = {name: self._folder / name for name in sorted(there, key=_turn)}
        with ExitStack() as opened:
            new = tuple(
                (name, opened.enter_context(_File(path)))
                for name, path in paths.items()
                if _version(path) != self._sent.get(name)  # a long run has sent thousands
            )
            return Taken(new, tuple(gone), opened.pop_all())

    def send(self, taken: Taken) -> None:
        """Have others see these files, and close them."""
        with taken.opened, self._sending, heard(self._advance.note):
            for name, file in taken.files:
                self._send(name, file)
            for name in taken.gone:
                self._elsewhere.remove(name)
                self._advance.note()
                self._sent.pop(name, None)

    @contextmanager
    def sending_rows(self) -> Iterator[None]:
        """Send many rows as soon as they are whole, so that restart points need not wait."""
        if not self._sends:
            yield
            return
        ended = threading.Event()

        def look() -> None:
            pause = _LOOK
            while not ended.wait(pause):
                begun = time.thread_time()
                rows = [name for name in self._files.running.names() if _is_rows(name)]
                pause = max(_LOOK, _RARELY * (time.thread_time() - begun))
                for name in rows:
                    if not ended.is_set():
                        with (
                            self._sending,
                            suppress(OSError, CatalogueError),  # `send` tries again
                            _File(self._folder / name) as file,
                            heard(self._advance.note),
                        ):
                            if file.size >= _LARGE:
                                self._send(name, file)

        thread = threading.Thread(target=look, name="rows", daemon=True)
        thread.start()
        try:
            yield
        finally:
            ended.set()
            thread.join()

    def send_sealed(self) -> None:
        """Send the sealed results of this attempt, if there are any and they are here."""
        for name in self._files.own_sealed():
            sealed = self._files.sealed(name)
            if sealed is not None and isinstance(sealed.object_store, Folder):
                path = Path(sealed.object_store.root) / sealed.key
                with _File(path) as file, heard(self._advance.note):
                    self._elsewhere.put(name, self._pieces(file))

    def _send(self, name: str, file: "_File") -> None:
        """Send a file that is not as it was sent: of one that is appended to, what is new."""
        sent = self._sent.get(name)
        if file.version == sent:
            return
        if (
            _is_journal(name)
            and sent is not None
            and sent[0] == file.version[0]
            and sent[1] < file.size
        ):
            self._elsewhere.append(name, sent[1], self._pieces(file, sent[1]))
        elif not self._adopted(name, file.version):
            self._elsewhere.put(name, self._pieces(file))
        self._sent[name] = file.version

    def _pieces(self, file: "_File", start: int = 0) -> "_Pieces":
        return _Pieces(file, start, self._advance)

    def _adopted(self, name: str, version: _Version) -> bool:
        """Have rows of an earlier attempt, which were linked to a name of this one, stay there."""
        if not _is_rows(name):
            return False
        linked = (one for one, sent in self._sent.items() if sent == version and _is_rows(one))
        source = next(linked, None)
        return source is not None and self._elsewhere.adopt(name, source)


class _File:
    """A file as it is when it is opened: what replaces it, or is appended later, is not read."""

    def __init__(self, path: Path) -> None:
        self.descriptor = os.open(path, os.O_RDONLY)
        self.version = _version(self.descriptor)
        self.size = self.version[1]

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        os.close(self.descriptor)


class _Pieces:
    """Bytes of a file from `start` on, which can be gone through more than once."""

    def __init__(self, file: _File, start: int, advance: Advance) -> None:
        self._file, self._start, self._advance = file, start, advance

    def __iter__(self) -> Iterator[bytes]:
        return noted(self._read(), self._advance.note)

    def _read(self) -> Iterator[bytes]:
        for start in range(self._start, self._file.size, _PIECE):
            length = min(_PIECE, self._file.size - start)
            yield os.pread(self._file.descriptor, length, start)


def _version(file: Path | int) -> _Version:
    found = os.stat(file)
    return found.st_ino, found.st_size, found.st_mtime_ns


def _is_rows(name: str) -> bool:
    return name.rpartition("/")[0].endswith(f"/{ROWS}")


def _is_journal(name: str) -> bool:
    """Whether a file is only ever appended to: that of the rows of a run that wait."""
    attempt, _, rest = name.partition("/")
    return attempt.startswith("a") and rest.startswith(f"{PARTS}/")


def _turn(name: str) -> tuple[int, str]:
    """Sort rows before the documents that announce them, and restart points last."""
    folder, _, file = name.rpartition("/")
    order = (_is_rows(name), file == DOCUMENTS, folder.endswith(PARTS), True)
    return order.index(True), name
