"""Object stores of results: where sealed stores are kept, each as one object under a key.

Each is a family member with one file and one line in `OBJECT_STORES`; what it must do is said by
`ObjectStore` and tested by `tests/storage/object_stores/contract.py`: objects are put whole, once,
and read by ranges; none is renamed or appended to. Only what a running job needs is replaced; see
`storage.running_files`.
"""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from typing import Final, Protocol

from jointplay.storage.object_stores.folder import Folder
from jointplay.storage.object_stores.s3 import Bucket


class ObjectStore(Protocol):
    """Objects by key; keys are names with slashes between them, as those of files."""

    @property
    def largest(self) -> float:
        """Most bytes that an object may have."""
        ...

    def put(self, key: str, pieces: Iterable[bytes]) -> None:
        """Store an object, given in pieces; it is there whole, and durable, on return.

        Readers do not see it meanwhile, nor after the writer was killed.

        Raises
        ------
        FileExistsError
            There is an object of this key, which stays as it is.
        storage.errors.TooLarge
            It has more bytes than `largest`.
        OSError
            It cannot be stored; nothing can be seen of it.
        """
        ...

    def replace(self, key: str, pieces: Iterable[bytes]) -> None:
        """Store an object as `put` does, in place of one that may be there.

        Readers see the one or the other.
        """
        ...

    def size(self, key: str) -> int:
        """Return the bytes of an object; FileNotFoundError if there is none."""
        ...

    def version(self, key: str) -> str | None:
        """Return what changes whenever an object's bytes do; none if there is no object."""
        ...

    def read(self, key: str, start: int, stop: int) -> bytes:
        """Return bytes [start, stop) of an object, fewer where it ends before.

        Raises
        ------
        FileNotFoundError
            There is no object of this key.
        """
        ...

    def entity_tag(self, key: str) -> str | None:
        """Return what the server says of an object's bytes, in most stores their MD5 in hex.

        None: the store has no server, or no such object.
        """
        ...

    def list(self, prefix: str) -> Iterator[str]:
        """Yield the keys of all objects that begin with a prefix, in no order."""
        ...

    def cut_off(self, prefix: str) -> Iterator[str]:
        """Yield what puts of keys with a prefix left that were cut off, and those under way.

        Each begins with the key that it was to become, and can be removed.
        """
        ...

    def remove(self, prefix: str) -> None:
        """Remove all objects whose keys begin so, and what puts that were cut off left of them."""
        ...

    def adopt(self, key: str, lost: str) -> bool:
        """Give the object of a lost attempt this key as well, durably.

        Returns whether there was one.

        An object that is there already stays.
        """
        ...

    def link(self, key: str, endpoint: str, seconds: float) -> str | None:
        """Sign an address below `endpoint` at which anyone may GET an object, for some time.

        None: the store answers no requests.
        """
        ...

    def link_to_put(self, key: str, endpoint: str, seconds: float, size: int) -> str | None:
        """Sign an address at which anyone may PUT an object of so many bytes, and of no others.

        None: the store answers no requests, or cannot sign that.
        """
        ...


OBJECT_STORES: Final[dict[str, Callable[[str], ObjectStore]]] = {"file": Folder, "s3": Bucket}
"""By the scheme of an object store's address; called with what follows it."""


@lru_cache(maxsize=8)
def object_store_at(address: str) -> ObjectStore:
    """Return the object store at an address such as ``file:/var/lib/jointplay/results``.

    Raises
    ------
    ValueError
        No object store has this scheme.
    """
    scheme, colon, path = address.partition(":")
    if not colon or scheme not in OBJECT_STORES:
        known = ", ".join(f"{name}:" for name in sorted(OBJECT_STORES))
        raise ValueError(f"{address!r} is no object store; addresses begin with {known}")
    return OBJECT_STORES[scheme](path)


@dataclass(frozen=True)
class StoredObject:
    """One object of an object store by its key, there or not yet."""

    object_store: ObjectStore
    key: str

    def put(self, pieces: Iterable[bytes]) -> None:
        """See `ObjectStore.put`."""
        self.object_store.put(self.key, pieces)

    def size(self) -> int:
        """See `ObjectStore.size`."""
        return self.object_store.size(self.key)

    def read(self, start: int, stop: int) -> bytes:
        """See `ObjectStore.read`."""
        return self.object_store.read(self.key, start, stop)

    def version(self) -> str | None:
        """See `ObjectStore.version`."""
        return self.object_store.version(self.key)

    def exists(self) -> bool:
        """Whether the object is there."""
        return self.version() is not None

    def __str__(self) -> str:
        return self.key
