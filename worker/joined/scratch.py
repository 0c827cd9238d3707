"""Files of one attempt on this machine, and those of the service that they are copies of."""

from base64 import b64encode
from collections.abc import Callable, Iterator
from hashlib import sha256
from pathlib import Path
from typing import IO, Final

from jointplay.storage.attempt_files import AttemptFiles
from jointplay.storage.catalogue.records import Block
from jointplay.storage.durable import PARTIAL
from jointplay.storage.packed.running import DOCUMENTS, PARTS, ROWS
from jointplay.storage.places.folder import Folder
from jointplay.storage.settings import Settings
from jointplay.worker.joined.connection import Connection
from jointplay.worker.joined.protocol import Files

_PIECE: Final = 2**20
_Version = tuple[int, int, int]
"""Inode, bytes and time of a file as the service has it."""


class Scratch:
    """Brings the files of an attempt here, and what changes in them to the service.

    Parameters
    ----------
    settings
        With a data folder of its own, which is empty.
    """

    def __init__(self, connection: Connection, settings: Settings, block: Block) -> None:
        self._connection = connection
        self._block = block
        self._files = AttemptFiles(settings, block)
        self._sent: dict[str, _Version] = {}

    def fetch(self, beat: Callable[[], None]) -> None:
        """Get what the attempt builds on; `beat` is called now and then."""
        for file in self._connection.ask(self._block, Files).files:
            try:
                self._files.put(file.name, self._beating(file.name, beat))
            except FileNotFoundError:  # replaced by the last one of its block, or removed
                continue
            if self._files.sealed(file.name) is None:
                self._sent[file.name] = _version(self._files.path(file.name))

    def _beating(self, name: str, beat: Callable[[], None]) -> Iterator[bytes]:
        for piece in self._connection.read(self._block, name):
            beat()
            yield piece

    def send(self) -> None:
        """Have the service know all files as they are now, those last that build on others."""
        there = {path.relative_to(self._files.folder).as_posix() for path in self._present()}
        for name in sorted(there, key=_turn):
            path = self._files.path(name)
            version, sent = _version(path), self._sent.get(name)
            if version == sent:
                continue
            offset = 0
            if sent is not None and _is_journal(name) and sent[0] == version[0]:
                offset = sent[1] if sent[1] < version[1] else 0
            with path.open("rb") as file:
                self._send(name, file, offset)
            self._sent[name] = version
        for name in self._sent.keys() - there:
            self._connection.remove(self._block, name)
            del self._sent[name]

    def send_sealed(self) -> None:
        """Send the sealed results of this attempt, if there are any."""
        for name in self._files.own_sealed():
            sealed = self._files.sealed(name)
            if sealed is not None and isinstance(sealed.place, Folder):
                with (Path(sealed.place.root) / sealed.key).open("rb") as file:
                    self._send(name, file, 0)

    def _send(self, name: str, file: IO[bytes], offset: int) -> None:
        """Send a file from an offset on; read twice, so that memory is bounded."""
        digest, size = sha256(), 0
        for piece in _pieces(file, offset):
            digest.update(piece)
            size += len(piece)
        told = f"sha-256=:{b64encode(digest.digest()).decode()}:"
        pieces = _pieces(file, offset)
        self._connection.write(self._block, name, pieces, size, told, offset)

    def _present(self) -> Iterator[Path]:
        for path in self._files.folder.rglob("*"):
            if path.is_file() and not path.name.endswith(PARTIAL):
                yield path


def _pieces(file: IO[bytes], offset: int) -> Iterator[bytes]:
    file.seek(offset)
    return iter(lambda: file.read(_PIECE), b"")


def _version(path: Path) -> _Version:
    found = path.stat()
    return found.st_ino, found.st_size, found.st_mtime_ns


def _is_journal(name: str) -> bool:
    """Whether a file is only ever appended to: that of the rows of a run that wait."""
    attempt, _, rest = name.partition("/")
    return attempt.startswith("a") and rest.startswith(f"{PARTS}/")


def _turn(name: str) -> tuple[int, str]:
    """Sort rows before the documents that announce them, and restart points last."""
    folder, _, file = name.rpartition("/")
    order = (folder.endswith(ROWS), file == DOCUMENTS, folder.endswith(PARTS), True)
    return order.index(True), name
