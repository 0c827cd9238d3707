"""The list of a sealed store's files with their checksums, the last file in it."""

import json
from collections.abc import Callable, Iterable, Iterator
from hashlib import sha256
from json.encoder import encode_basestring_ascii as _quoted

from jointplay.storage.errors import CorruptStore, NotAStore
from jointplay.storage.packed import Files, Packed
from jointplay.storage.results.layout import MANIFEST, SCHEMA_VERSION

_MOST_NAMED = 5


def listed(entries: Iterable[tuple[str, bytes]]) -> Iterator[tuple[str, bytes]]:
    """Pass on key and content of every file, then those of the manifest."""
    files = []
    for key, content in entries:
        about = f'{{\n"bytes": {len(content)},\n"sha256": "{sha256(content).hexdigest()}"\n}}'
        files.append(f"{_quoted(key)}: {about}")
        yield key, content
    # as json.dumps writes it with indent=0, which takes ten times as long
    listed = "{\n" + ",\n".join(files) + "\n}" if files else "{}"
    document = f'{{\n"result_schema": {json.dumps(SCHEMA_VERSION)},\n"files": {listed}\n}}'
    yield MANIFEST, document.encode()


def verify(files: Files, advanced: Callable[[], None] = lambda: None) -> None:
    """Compare every file with the manifest; `advanced` is called before each.

    Raises
    ------
    NotAStore
        The store was never sealed.
    CorruptStore
        Files are missing, differ, or have been added; the sentence names the first of them.
    """
    if not isinstance(files, Packed):
        raise NotAStore("results that are not sealed have no manifest to be compared with")
    try:
        expected = json.loads(files.read(MANIFEST))["files"]
    except (FileNotFoundError, ValueError, KeyError, TypeError) as error:
        raise NotAStore(f"{MANIFEST} of {files.source} cannot be read: {error}") from error
    present = set(files) - {MANIFEST}
    findings = [f"{key} is missing" for key in expected if key not in present]
    findings += [f"{key} was added" for key in sorted(present - expected.keys())]
    findings += [
        f"{key} has other bytes"
        for key, entry in expected.items()
        if key in present and _digest(files, key, advanced) != entry["sha256"]
    ]
    if findings:
        rest = len(findings) - _MOST_NAMED
        more = f" and {rest} more" if rest > 0 else ""
        raise CorruptStore(
            f"{files.source} is not what was sealed: {'; '.join(findings[:_MOST_NAMED])}{more}"
        )


def _digest(files: Files, key: str, advanced: Callable[[], None]) -> str:
    advanced()
    return sha256(files.read(key)).hexdigest()
