"""Files of an attempt that a service keeps: see `worker.scratch.files.Elsewhere`."""

from base64 import b64encode
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from hashlib import sha256

from jointplay.storage.catalogue.records import Block
from jointplay.worker.joined.bucket import BucketOfService
from jointplay.worker.joined.connection import Connection
from jointplay.worker.joined.protocol import Files


@dataclass(frozen=True)
class FilesOfService:
    """Those of one block that is held."""

    connection: Connection
    bucket: BucketOfService
    block: Block

    def needed(self) -> Iterator[tuple[str, int]]:
        """Give name and bytes of what the attempt builds on."""
        for file in self.connection.ask(self.block, Files).files:
            yield file.name, file.size

    def read(self, name: str) -> Iterator[bytes]:
        """GET a file."""
        return self.connection.read(self.block, name)

    def put(self, name: str, pieces: Iterable[bytes]) -> None:
        """PUT a file: a large one into the bucket, if there is one that can be reached."""
        digest, size = _digest(pieces)
        if not self.bucket.put(self.block, name, pieces, size, digest.hex()):
            self._write(name, pieces, size, digest, 0)

    def append(self, name: str, offset: int, pieces: Iterable[bytes]) -> None:
        """PUT what a file has from an offset on; read twice, so that memory is bounded."""
        digest, size = _digest(pieces)
        self._write(name, pieces, size, digest, offset)

    def adopt(self, name: str, source: str) -> bool:
        """Say that a service gives no file a second name."""
        return False

    def remove(self, name: str) -> None:
        """DELETE a file."""
        self.connection.remove(self.block, name)

    def _write(
        self, name: str, pieces: Iterable[bytes], size: int, digest: bytes, offset: int
    ) -> None:
        told = f"sha-256=:{b64encode(digest).decode()}:"
        self.connection.write(self.block, name, pieces, size, told, offset)


def _digest(pieces: Iterable[bytes]) -> tuple[bytes, int]:
    """Return SHA-256 and number of all bytes."""
    digest, size = sha256(), 0
    for piece in pieces:
        digest.update(piece)
        size += len(piece)
    return digest.digest(), size
