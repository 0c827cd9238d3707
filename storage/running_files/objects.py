"""Files of a running job in an object store, so that no two machines need share a folder.

An object cannot be appended to: a file is one object or several, whose keys end with the byte of
the file that each begins with, such as ``a1/parts/00000001+000000004096``.
"""

from collections.abc import Callable, Hashable, Iterable, Iterator
from dataclasses import dataclass, field
from typing import Final, Self, TypeVar

from jointplay.storage.object_stores import ObjectStore, StoredObject

_MOST_PIECES: Final = 16
"""Objects of one file, after which all of it is put as one again."""
_FIRST: Final = f"+{0:012d}"
Answer = TypeVar("Answer")


@dataclass
class InObjectStore:
    """See `storage.running_files.RunningFiles`.

    Those who read have one for each moment: names are those that were last listed, and, of the
    only one who writes a file, its own.

    Parameters
    ----------
    prefix
        Of the keys, with no slash behind it.
    """

    object_store: ObjectStore
    prefix: str
    _listed: set[str] | None = field(default=None, init=False, repr=False, compare=False)

    @property
    def name(self) -> str:
        """Name of the folder."""
        return self.prefix.rpartition("/")[2]

    def __str__(self) -> str:
        return self.prefix

    def below(self, name: str) -> Self:
        """Return the files of a folder in this one."""
        return type(self)(self.object_store, f"{self.prefix}/{name}")

    def names(self, folder: str = "") -> Iterator[str]:
        """List the objects."""
        self._listed = None
        inside = f"{folder}/" if folder else ""
        for key in sorted(self._known()):
            if key.endswith(_FIRST) and key.startswith(inside):
                yield key.removesuffix(_FIRST)

    def has(self, name: str) -> bool:
        """Look into the list."""
        return f"{name}{_FIRST}" in self._known()

    def size(self, name: str) -> int:
        """Return where the last piece ends."""
        return self._again(self._size, name)

    def stamp(self, name: str) -> Hashable | None:
        """Return None: a list of objects does not tell."""
        return None

    def read(self, name: str) -> bytes:
        """Join the pieces; what the first one has, and was put again with it, is not read again."""
        return self._again(self._joined, name)

    def object(self, name: str) -> StoredObject:
        """Name the first piece, which is all of it."""
        return StoredObject(self.object_store, self._key(name))

    def put(self, name: str, pieces: Iterable[bytes]) -> None:
        """Replace the first piece, which is all of it then."""
        known = self._known()
        self.object_store.replace(self._key(name), pieces)
        for later in [one for one in known if _is_piece(one, name) and not one.endswith(_FIRST)]:
            self.object_store.remove(f"{self.prefix}/{later}")
            known.discard(later)
        known.add(f"{name}{_FIRST}")

    def append(self, name: str, offset: int, pieces: Iterable[bytes]) -> None:
        """Put one more piece, or all of the file in one if there are many."""
        there = self._pieces(name)
        if offset > self._size(name):
            raise ValueError(f"{name!r} has fewer than {offset} bytes")
        if len(there) < _MOST_PIECES and offset >= there[-1][0]:
            self.object_store.replace(f"{self.prefix}/{name}+{offset:012d}", pieces)
            self._known().add(f"{name}+{offset:012d}")
        else:
            self.put(name, [self._joined(name)[:offset], *pieces])

    def adopt(self, name: str, source: str) -> bool:
        """Have the object store copy the object."""
        self._listed = None  # it may not have been there
        return self.object_store.adopt(self._key(name), self._key(source))

    def remove(self, name: str) -> None:
        """Remove all pieces."""
        self._listed = None
        self.object_store.remove(f"{self.prefix}/{name}+")

    def clear(self) -> None:
        """Remove all objects."""
        self._listed = None
        self.object_store.remove(f"{self.prefix}/")

    def _again(self, ask: Callable[[str], Answer], name: str) -> Answer:
        """Ask again, if it is not there any more as it was listed."""
        known = self._listed is not None
        try:
            return ask(name)
        except FileNotFoundError:
            if not known:
                raise
            self._listed = None
        return ask(name)

    def _size(self, name: str) -> int:
        offset, key = self._pieces(name)[-1]
        return offset + self.object_store.size(key)

    def _joined(self, name: str) -> bytes:
        content = bytearray()
        pieces = self._pieces(name)
        ends = [offset for offset, _ in pieces[1:]]
        for (offset, key), end in zip(pieces, [*ends, None], strict=True):
            if end is not None and end <= len(content):
                continue
            piece = self.object_store.read(key, 0, self.object_store.size(key))
            if offset + len(piece) > len(content):
                del content[offset:]
                content += piece
        return bytes(content)

    def _pieces(self, name: str) -> list[tuple[int, str]]:
        """Return offset and key of each piece, in order; FileNotFoundError if there is none."""
        found = sorted(key for key in self._known() if _is_piece(key, name))
        if not found:
            raise FileNotFoundError(f"{self.prefix}/{name} is not there")
        return [(int(key.rpartition("+")[2]), f"{self.prefix}/{key}") for key in found]

    def _known(self) -> set[str]:
        if self._listed is None:
            begin = len(self.prefix) + 1
            self._listed = {key[begin:] for key in self.object_store.list(f"{self.prefix}/")}
        return self._listed

    def _key(self, name: str) -> str:
        return f"{self.prefix}/{name}{_FIRST}"


def _is_piece(key: str, name: str) -> bool:
    return key.rpartition("+")[0] == name
