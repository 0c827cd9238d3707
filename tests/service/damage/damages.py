"""Damages to a file: a bit of each of its parts flipped, cut off, emptied, removed, exchanged."""

import random
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Final

from jointplay.storage.object_stores import StoredObject
from jointplay.storage.packed import Packed, Running
from jointplay.storage.packed.running import PARTS, ROWS
from tests.service.damage.subjects import File, Subject

WHOLE: Final = ("flip directory", "flip end", "truncate", "empty", "remove", "swap")
"""Damages after which nothing in a packed file is found."""


@dataclass(frozen=True)
class Damage:
    """Content of a file instead of what it held; None: it is gone."""

    name: str
    file: File
    content: bytes | None = field(repr=False)
    keys: tuple[str, ...] = ()
    """Documents and chunks of arrays that it strikes, as far as the file has any."""

    def __str__(self) -> str:
        return f"{self.name} of {self.file.name} {self.keys[0] if len(self.keys) == 1 else ''}"

    @property
    def names(self) -> tuple[str, ...]:
        """Words of which one must be in what is said of it; of a block's part, the block's."""
        name = self.file.name.rpartition("/")[2]
        if self.file.folder != PARTS:
            return name, *self.keys
        return name.partition("-a")[0], f"the journal in {PARTS}"

    def strike(self) -> None:
        """Do it."""
        put(self.file.stored, self.content)


def damages(subject: Subject, chance: random.Random) -> Iterator[Damage]:
    """Yield every damage to every file of a subject, and to every file that is packed in it."""
    for file in subject.files:
        content = content_of(file.stored)
        places = list(_places(subject, file, content, chance))
        keys = tuple(key for _, _, key in places if key is not None)
        for name, at, key in places:
            flipped = bytearray(content)
            flipped[at] ^= 1 << chance.randrange(8)
            yield Damage(f"flip {name}", file, bytes(flipped), keys if key is None else (key,))
        cut = chance.randrange(len(content) // 2, len(content))
        others: dict[str, bytes | None] = {
            "truncate": content[:cut],
            "empty": b"",
            "remove": None,
            "swap": content_of(file.like),
        }
        if (sibling := _sibling(subject, file)) is not None:
            others["swap within"] = content_of(sibling.stored)
        for name, instead in others.items():
            yield Damage(name, file, instead, keys)


def content_of(stored: StoredObject) -> bytes:
    """Return all bytes of an object."""
    return stored.read(0, stored.size())


def put(stored: StoredObject, content: bytes | None) -> None:
    """Give an object these bytes; None: remove it."""
    if content is None:
        stored.object_store.remove(stored.key)
    else:
        stored.object_store.replace(stored.key, [content])


def _places(
    subject: Subject, file: File, content: bytes, chance: random.Random
) -> Iterator[tuple[str, int, str | None]]:
    """Yield name, place and key of a byte in each file that is packed in one, and behind them."""
    size = len(content)
    if not file.name.endswith(".zip"):
        yield "content", chance.randrange(size), None
        return
    found = Packed(file.stored, _digest_of(subject, file))
    for key in found:
        entry = found.entry(key)
        if entry.size and chance.random() < 0.7:
            yield "content", entry.offset + chance.randrange(entry.size), key
        else:
            yield "header", entry.offset - 1 - chance.randrange(30), key
    behind = max(one.offset + one.size for one in found.entries.values())
    yield "directory", chance.randrange(behind, size - 21), None
    yield "end", chance.randrange(size - 21, size), None


def _sibling(subject: Subject, file: File) -> File | None:
    """Return another file of the same store and sort, if there is one."""
    if file.folder not in (ROWS, PARTS):
        return None
    alike = (one for one in subject.files if one.folder == file.folder and one != file)
    return next(alike, None)


def _digest_of(subject: Subject, file: File) -> bytes:
    """Return the digest that a packed file is checked with: files of rows alone do not hold it."""
    if subject.filled is None or file.folder != ROWS:
        return b""
    return Running(subject.filled).digest
