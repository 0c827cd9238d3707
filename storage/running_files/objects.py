"""Files of a running job as objects of a place, so that no two machines need share a folder.

An object cannot be appended to: a file is one object or several, whose keys end with the byte of
the file that each begins with, such as ``a1/parts/00000001+000000004096``.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import Final, Self

from jointplay.storage.places import Place, StoredObject

_MOST_PIECES: Final = 64
"""Objects of one file, after which all of it is put as one again."""
_FIRST: Final = f"+{0:012d}"


@dataclass
class InPlace:
    """See `storage.running_files.RunningFiles`.

    Those who read have one for each moment: `version` and `read` go by the names that there were
    when they were last listed.

    Parameters
    ----------
    prefix
        Of the keys, with no slash behind it.
    """

    place: Place
    prefix: str
    _listed: frozenset[str] | None = field(default=None, init=False, repr=False, compare=False)

    @property
    def name(self) -> str:
        """Of the folder."""
        return self.prefix.rpartition("/")[2]

    def __str__(self) -> str:
        return self.prefix

    def below(self, name: str) -> Self:
        """Return the files of a folder in this one."""
        return type(self)(self.place, f"{self.prefix}/{name}")

    def names(self, folder: str = "") -> Iterator[str]:
        """List the objects."""
        begin = len(self.prefix) + 1
        self._listed = frozenset(key[begin:] for key in self.place.list(f"{self.prefix}/"))
        inside = f"{folder}/" if folder else ""
        for key in sorted(self._listed):
            if key.endswith(_FIRST) and key.startswith(inside):
                yield key.removesuffix(_FIRST)

    def version(self, name: str) -> str | None:
        """Look into the list."""
        return "there" if f"{name}{_FIRST}" in self._known() else None

    def size(self, name: str) -> int:
        """Return where the last piece ends."""
        *_, (offset, key) = self._pieces(name)
        return offset + self.place.size(key)

    def read(self, name: str) -> bytes:
        """Join the pieces; what the first one has, and was put again with it, is not read again."""
        content = b""
        pieces = self._pieces(name)
        ends = [offset for offset, _ in pieces[1:]]
        for (offset, key), end in zip(pieces, [*ends, None], strict=True):
            if end is not None and end <= len(content):
                continue
            piece = self.place.read(key, 0, self.place.size(key))
            if offset + len(piece) > len(content):
                content = content[:offset] + piece
        return content

    def object(self, name: str) -> StoredObject:
        """Name the first piece, which is all of it."""
        return StoredObject(self.place, self._key(name))

    def put(self, name: str, pieces: Iterable[bytes]) -> None:
        """Replace the first piece."""
        self._listed = None
        self.place.replace(self._key(name), pieces)

    def append(self, name: str, offset: int, pieces: Iterable[bytes]) -> None:
        """Put one more piece, or all of the file in one if there are many."""
        self._listed = None
        there = self._pieces(name)
        if offset > self.size(name):
            raise ValueError(f"{name!r} has fewer than {offset} bytes")
        self._listed = None
        if len(there) < _MOST_PIECES:
            self.place.replace(f"{self.prefix}/{name}+{offset:012d}", pieces)
            return
        self.put(name, [self.read(name)[:offset], *pieces])
        for _, key in there[1:]:
            self.place.remove(key)

    def adopt(self, name: str, source: str) -> bool:
        """Have the place copy the object."""
        self._listed = None
        return self.place.adopt(self._key(name), self._key(source))

    def remove(self, name: str) -> None:
        """Remove all pieces."""
        self._listed = None
        self.place.remove(f"{self.prefix}/{name}+")

    def clear(self) -> None:
        """Remove all objects."""
        self._listed = None
        self.place.remove(f"{self.prefix}/")

    def _pieces(self, name: str) -> list[tuple[int, str]]:
        """Return offset and key of each piece, in order; FileNotFoundError if there is none."""
        for _ in range(2):
            found = sorted(key for key in self._known() if key.rpartition("+")[0] == name)
            if found:
                return [(int(key.rpartition("+")[2]), f"{self.prefix}/{key}") for key in found]
            self._listed = None
        raise FileNotFoundError(f"{self.prefix}/{name} is not there")

    def _known(self) -> frozenset[str]:
        if self._listed is None:
            [*self.names()]
        return self._listed or frozenset()

    def _key(self, name: str) -> str:
        return f"{self.prefix}/{name}{_FIRST}"
