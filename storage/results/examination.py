"""A sealed store that another program handed in: every byte of it is read, once, before it counts.

Its files must be those of its manifest, with these checksums; its documents those that its job's
layout gives; and every chunk must be one that they speak of, and can be decoded. What the numbers
are, only a repetition of the job shows.
"""

import json
import struct
from collections import deque
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, Final

from jointplay.storage.errors import CorruptStore, NotAStore
from jointplay.storage.packed.ranges import Ranges
from jointplay.storage.packed.reading import Packed
from jointplay.storage.results.chunk_files import ChunkFiles
from jointplay.storage.results.layout import MANIFEST
from jointplay.storage.results.manifest import listed
from jointplay.storage.results.metadata import FILE, Document

LARGEST_DOCUMENT: Final = 2**26
"""Bytes of a document that is read; one of 100 000 points has some millions."""
_ABOUT: Final = 512
"""Bytes of a file in directory and manifest at most."""
_FEW: Final = 256
"""Files of any store: documents of groups, the manifest."""
_MOST_FILES: Final = 2**18
"""Files of a store of which nothing is known beforehand."""
ODD: Final = (
    *(ValueError, KeyError, TypeError, IndexError, AttributeError),
    *(RecursionError, struct.error, OverflowError),
)
"""Errors of reading what another program may have made up."""
_CLOSE: Final = 1e-9
"""Relative difference of numbers that processors of several classes compute for one document."""


@dataclass(frozen=True)
class Expected:
    """Files that a store must have, and those that it may have.

    Parameters
    ----------
    documents
        Bytes by key.
    arrays
        Documents of all arrays by path.
    partial
        Beginnings of the paths of arrays of which chunks may be missing.
    others
        Checks of further files by key.
    """

    documents: Mapping[str, bytes]
    arrays: Mapping[str, Document]
    partial: tuple[str, ...] = ()
    others: Mapping[str, Callable[[bytes], None]] = field(default_factory=dict)


def opened(source: Ranges, files: int = _MOST_FILES) -> tuple[Packed, Document]:
    """Open a store of so many files at most. Returns it with the attributes of its root.

    Raises
    ------
    CorruptStore
        It is none.
    """
    try:
        found = Packed(source, most=_ABOUT * (files + _FEW))
        found.require_in_order()  # none over another, twice, or with other bytes between
        root = json.loads(_document(found, FILE))["attributes"]
        if not isinstance(root, dict):
            raise TypeError("attributes are no object")
    except (*ODD, NotAStore, FileNotFoundError) as error:
        raise CorruptStore(f"{source} is no store of results: {error}") from error
    return found, root


def examine(files: Packed, expected: Expected | None) -> None:
    """Read all of a store; memory is bounded by its largest file.

    Parameters
    ----------
    files
        Of the store, as `opened` gave them.
    expected
        None where that is not known: then the manifest alone is looked at.

    Raises
    ------
    CorruptStore
        With the first file that is not as it must be.
    """
    try:
        ((_, manifest),) = deque(listed(_entries(files, expected)), maxlen=1)
        if files.read(MANIFEST) != manifest:
            raise CorruptStore(f"{MANIFEST} of {files.source} is not that of its files")
    except (*ODD, FileNotFoundError) as error:
        raise CorruptStore(f"{files.source} cannot be read: {error}") from error


def _entries(files: Packed, expected: Expected | None) -> Iterator[tuple[str, bytes]]:
    """Give key and content of every file but the manifest, once it was found right."""
    arrays: dict[str, ChunkFiles] = {}
    if expected is not None:
        arrays = {path: ChunkFiles(path, one) for path, one in expected.arrays.items()}
        _require_all(files, expected, arrays)
    for key, entry in files.entries.items():
        if key == MANIFEST:
            if entry.size > _ABOUT * len(files.entries) + _ABOUT:
                raise CorruptStore(f"{MANIFEST} of {files.source} is too large")
            continue
        path, _, index = key.rpartition("/c/")
        of_array = arrays.get(path)
        if entry.size > (of_array.largest if of_array else LARGEST_DOCUMENT):
            raise CorruptStore(f"{key} of {files.source} is too large")
        content = files.read(key)
        if expected is not None:
            try:
                _check(key, content, expected, of_array, index)
            except CorruptStore as error:
                raise CorruptStore(f"{key} of {files.source}: {error}") from error
        yield key, content


def _require_all(files: Packed, expected: Expected, arrays: Mapping[str, ChunkFiles]) -> None:
    needed = [*expected.documents, MANIFEST]
    for path, one in arrays.items():
        if not path.startswith(expected.partial):
            if one.count > len(files.entries):
                raise CorruptStore(f"{files.source} lacks files of {path}")
            needed += one.keys()
    missing = [key for key in needed if key not in files.entries]
    if missing:
        raise CorruptStore(f"{files.source} lacks {len(missing)} files, such as {missing[0]}")


def _check(
    key: str, content: bytes, expected: Expected, of_array: ChunkFiles | None, index: str
) -> None:
    if of_array is not None:
        if not of_array.has(index):
            raise CorruptStore("the array has no such chunk")
        of_array.check(index, content)
    elif key in expected.others:
        expected.others[key](content)
    elif expected.documents.get(key) != content:
        raise CorruptStore("it is not the document that the job has")


def require_alike(found: Mapping[str, Any], expected: Mapping[str, Any], but: set[str]) -> None:
    """Raise `CorruptStore` if attributes of a root, `but` some, are not those of a layout.

    Numbers may differ in their last bits: another class of processors may have computed them.
    """
    if found.keys() - but != expected.keys() - but:
        odd = sorted((found.keys() ^ expected.keys()) - but)
        raise CorruptStore(f"the attributes of a store of this job are others: {', '.join(odd)}")
    wanted = json.loads(json.dumps(expected))  # tuples are lists there
    for name in wanted.keys() - but:
        if not _alike(found[name], wanted[name]):
            raise CorruptStore(f"the attribute {name} is not that of this job")


def _alike(one: Any, other: Any) -> bool:
    if isinstance(one, dict) and isinstance(other, dict):
        return one.keys() == other.keys() and all(_alike(one[name], other[name]) for name in one)
    if isinstance(one, list) and isinstance(other, list):
        return len(one) == len(other) and all(map(_alike, one, other))
    if isinstance(one, float) and isinstance(other, float):
        return abs(one - other) <= _CLOSE * max(abs(one), abs(other))
    return type(one) is type(other) and bool(one == other)


def require_same_shapes(files: Packed, arrays: Mapping[str, Document]) -> None:
    """Raise `CorruptStore` if arrays are missing, or of other shapes or types."""
    for path, wanted in arrays.items():
        try:
            found = json.loads(_document(files, f"{path}/{FILE}"))
            same = all(found[name] == wanted[name] for name in ("shape", "data_type"))
        except (*ODD, FileNotFoundError) as error:
            raise CorruptStore(f"{files.source} has no array {path}: {error}") from error
        if not same:
            raise CorruptStore(f"{path} of {files.source} has another shape than this job gives")


def _document(files: Packed, key: str) -> bytes:
    if files.entry(key).size > LARGEST_DOCUMENT:
        raise CorruptStore(f"{key} of {files.source} is too large")
    return files.read(key)
