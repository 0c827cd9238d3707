"""The files of a store for zarr-python: a read-only `zarr.abc.store.Store`."""

from collections.abc import AsyncIterator, Iterable

from zarr.abc.store import (
    ByteRequest,
    OffsetByteRequest,
    RangeByteRequest,
    Store,
    SuffixByteRequest,
)
from zarr.core.buffer import Buffer, BufferPrototype

from jointplay.storage.packed.reading import Files


class FilesStore(Store):
    """Reads keys where they are; a read takes microseconds and is not worth a thread."""

    supports_writes = False
    supports_deletes = False
    supports_listing = True

    def __init__(self, files: Files) -> None:
        super().__init__(read_only=True)
        self._files = files

    def __eq__(self, other: object) -> bool:
        return isinstance(other, FilesStore) and other._files is self._files

    async def get(
        self, key: str, prototype: BufferPrototype, byte_range: ByteRequest | None = None
    ) -> Buffer | None:
        """Return a file, or a range of its bytes; None if it is not there."""
        try:
            start, stop = self._window(key, byte_range)
            return prototype.buffer.from_bytes(self._files.read(key, start, stop))
        except FileNotFoundError:
            return None

    async def get_partial_values(
        self,
        prototype: BufferPrototype,
        key_ranges: Iterable[tuple[str, ByteRequest | None]],
    ) -> list[Buffer | None]:
        """Return several ranges, in order."""
        return [await self.get(key, prototype, byte_range) for key, byte_range in key_ranges]

    async def exists(self, key: str) -> bool:
        """Whether there is such a file."""
        try:
            self._files.entry(key)
        except FileNotFoundError:
            return False
        return True

    async def set(self, key: str, value: Buffer) -> None:
        """Refuse: `ValueError`."""
        self._check_writable()

    async def delete(self, key: str) -> None:
        """Refuse: `ValueError`."""
        self._check_writable()

    async def list(self) -> AsyncIterator[str]:
        """Yield all keys."""
        for key in self._files:
            yield key

    async def list_prefix(self, prefix: str) -> AsyncIterator[str]:
        """Yield all keys that begin so."""
        for key in self._files:
            if key.startswith(prefix):
                yield key

    async def list_dir(self, prefix: str) -> AsyncIterator[str]:
        """Yield the names right below a group."""
        begin = f"{prefix.rstrip('/')}/" if prefix else ""
        found = {
            key[len(begin) :].partition("/")[0] for key in self._files if key.startswith(begin)
        }
        for name in sorted(found):
            yield name

    def _window(self, key: str, wanted: ByteRequest | None) -> tuple[int, int | None]:
        match wanted:
            case RangeByteRequest(start, end):
                return start, end
            case OffsetByteRequest(offset):
                return offset, None
            case SuffixByteRequest(suffix):
                return max(self._files.entry(key).size - suffix, 0), None
        return 0, None
