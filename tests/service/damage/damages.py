"""Damages to a file: a bit of each of its parts flipped, cut off, emptied, removed, exchanged."""

import random
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final

from jointplay.storage.packed import Packed, Running
from jointplay.storage.packed.running import DOCUMENTS, PARTS, ROWS
from jointplay.storage.places import StoredObject
from jointplay.storage.places.folder import Folder
from tests.service.damage.subjects import Subject

WHOLE: Final = ("flip directory", "flip end", "truncate", "empty", "remove", "swap")
"""Damages after which nothing in a packed file is found."""


@dataclass(frozen=True)
class Damage:
    """Content of a file instead of what it held; None: it is gone."""

    name: str
    path: Path
    content: bytes | None = field(repr=False)
    keys: tuple[str, ...] = ()
    """Documents and chunks of arrays that it strikes, as far as the file has any."""

    def __str__(self) -> str:
        return f"{self.name} of {self.path.name} {self.keys[0] if len(self.keys) == 1 else ''}"

    @property
    def names(self) -> tuple[str, ...]:
        """Words of which one must be in what is said of it; of a block's part, the block's."""
        if self.path.parent.name != PARTS:
            return self.path.name, *self.keys
        return self.path.name.partition("-a")[0], f"the journal in {PARTS}"

    def strike(self) -> None:
        """Do it."""
        _put(self.path, self.content)


def damages(subject: Subject, chance: random.Random) -> Iterator[Damage]:
    """Yield every damage to every file of a subject, and to every file that is packed in it."""
    for path in subject.files:
        content = path.read_bytes()
        places = list(_places(path, content, chance))
        keys = tuple(key for _, _, key in places if key is not None)
        for name, at, key in places:
            flipped = bytearray(content)
            flipped[at] ^= 1 << chance.randrange(8)
            yield Damage(f"flip {name}", path, bytes(flipped), keys if key is None else (key,))
        cut = chance.randrange(len(content) // 2, len(content))
        others: dict[str, bytes | None] = {
            "truncate": content[:cut],
            "empty": b"",
            "remove": None,
            "swap": subject.like(path).read_bytes(),
        }
        if (sibling := _sibling(path)) is not None:
            others["swap within"] = sibling.read_bytes()
        for name, instead in others.items():
            yield Damage(name, path, instead, keys)


def restore(path: Path, content: bytes) -> None:
    """Undo damages: give a file the bytes that it had."""
    _put(path, content)


def _places(
    path: Path, content: bytes, chance: random.Random
) -> Iterator[tuple[str, int, str | None]]:
    """Yield name, place and key of a byte in each file that is packed in one, and behind them."""
    size = len(content)
    if path.suffix != ".zip":
        yield "content", chance.randrange(size), None
        return
    found = Packed(StoredObject(Folder(str(path.parent)), path.name), _owner_of(path))
    for key in found:
        entry = found.entry(key)
        if entry.size and chance.random() < 0.7:
            yield "content", entry.offset + chance.randrange(entry.size), key
        else:
            yield "header", entry.offset - 1 - chance.randrange(30), key
    behind = max(one.offset + one.size for one in found.entries.values())
    yield "directory", chance.randrange(behind, size - 21), None
    yield "end", chance.randrange(size - 21, size), None


def _sibling(path: Path) -> Path | None:
    """Return another file of the same store and sort, if there is one."""
    if path.parent.name not in (ROWS, PARTS):
        return None
    found = [one for one in sorted(path.parent.iterdir()) if one != path]
    return found[0] if found else None


def _owner_of(path: Path) -> bytes:
    """Return whose a packed file is: only files of rows do not say it themselves."""
    if path.name == DOCUMENTS or path.parent.name != ROWS:
        return b""
    return Running(path.parent.parent).owner


def _put(path: Path, content: bytes | None) -> None:
    if content is None:
        path.unlink(missing_ok=True)
    else:
        path.write_bytes(content)
