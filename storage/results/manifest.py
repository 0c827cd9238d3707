"""The list of a sealed store's files, written last: a store that has it is all on the disk."""

import json
import os
from collections.abc import Callable, Iterator
from pathlib import Path

from jointplay.storage.results.durable import PARTIAL, DurableFolder, Record, measure
from jointplay.storage.results.errors import CorruptStore, NotAStore
from jointplay.storage.results.layout import MANIFEST, SCHEMA_VERSION

_MOST_NAMED = 5


def seal(folder: DurableFolder, advanced: Callable[[], None] = lambda: None) -> None:
    """Write the manifest of all files of a store and make it durable.

    `advanced` is called after each file.
    """
    files = {}
    for key in sorted(keys(folder.root)):
        record = folder.record(key)
        files[key] = {"bytes": record.size, "sha256": record.digest}
        advanced()
    document = {"result_schema": SCHEMA_VERSION, "files": files}
    folder.write(MANIFEST, json.dumps(document, indent=0).encode())
    folder.commit()


def keys(root: Path) -> Iterator[str]:
    """List the files of a store but the manifest itself, as paths with slashes.

    What is still being written is none of them: hidden folders, and files that have not got
    their name yet. A worker that comes back late may leave some even beside a sealed store.
    """
    for key in _files(root, ""):
        if key != MANIFEST and not key.startswith(".") and not key.endswith(PARTIAL):
            yield key


def _files(folder: Path | str, prefix: str) -> Iterator[str]:
    """List files without a look at each: a store has hundreds."""
    with os.scandir(folder) as entries:
        for entry in entries:
            if entry.is_dir(follow_symlinks=False):
                yield from _files(entry.path, f"{prefix}{entry.name}/")
            elif entry.is_file():
                yield prefix + entry.name


def read(root: Path) -> dict[str, Record]:
    """Read which files a sealed store has.

    Raises
    ------
    NotAStore
        There is no manifest, or none that can be read.
    """
    try:
        document = json.loads((root / MANIFEST).read_bytes())
        return {
            key: Record(entry["bytes"], entry["sha256"]) for key, entry in document["files"].items()
        }
    except FileNotFoundError as error:
        raise NotAStore(f"{root} has no {MANIFEST}: it was never sealed") from error
    except (ValueError, KeyError, TypeError) as error:
        raise NotAStore(f"{root / MANIFEST} cannot be read: {error}") from error


def verify(root: Path) -> None:
    """Compare every file with the manifest.

    Raises
    ------
    NotAStore
        The store was never sealed.
    CorruptStore
        Files are missing, differ, or have been added; the sentence names the first of them.
    """
    expected = read(root)
    present = set(keys(root))
    findings = [f"{key} is missing" for key in expected if key not in present]
    findings += [f"{key} was added" for key in sorted(present - expected.keys())]
    findings += [
        f"{key} has other bytes"
        for key, record in expected.items()
        if key in present and measure(root / key) != record
    ]
    if findings:
        rest = len(findings) - _MOST_NAMED
        more = f" and {rest} more" if rest > 0 else ""
        raise CorruptStore(
            f"{root} is not what was sealed: {'; '.join(findings[:_MOST_NAMED])}{more}"
        )
