"""Results of a study that another program handed in, against the layout that the job gives."""

import json
import re
from collections.abc import Mapping
from dataclasses import replace
from typing import Any, Final

from jointplay.storage.errors import CorruptStore
from jointplay.storage.packed.ranges import Ranges
from jointplay.storage.packed.reading import Packed
from jointplay.storage.packed.running import DOCUMENTS
from jointplay.storage.results import metadata
from jointplay.storage.results.examination import (
    ODD,
    Expected,
    examine,
    opened,
    require_alike,
    require_same_shapes,
)
from jointplay.storage.results.metadata import FILE, Document
from jointplay.storage.studies import documents
from jointplay.storage.studies.examined_part import MOST_NUMBERS
from jointplay.storage.studies.layout import StudyLayout
from jointplay.storage.studies.points import INDICATORS, STATISTICS
from jointplay.storage.studies.store import FAILURES, REASONS, RESULTS

_OWN: Final = frozenset({"complete", "failures", "summary", "layout"})
"""Attributes that the job does not give: the digest of the layout is one of all its last bits."""
_SECTIONS: Final = "sections/"
_NUMBERS: Final = (f"{STATISTICS}/", f"{INDICATORS}/")
_DIGEST: Final = re.compile("[0-9a-f]{64}")


def examined_study(source: Ranges, layout: StudyLayout, *, same: bool) -> Document:
    """Read a whole sealed study, and return the attributes of its root.

    The parameters, and `CorruptStore`, are as for `results.examined_run.examined_run`.
    """
    rows, columns = layout.chunk
    chunks = (layout.points // rows + 1) * (layout.record // columns + 1)
    files, root = opened(source, chunks * (len(layout.observables) + 1) + 2 * MOST_NUMBERS)
    summary, failures = root.get("summary"), root.get("failures")
    if root.get("complete") is not True or not isinstance(summary, dict):
        raise CorruptStore(f"{source} is no study that came to its end")
    if not (isinstance(failures, list) and all(isinstance(one, str) for one in failures)):
        raise CorruptStore(f"{source} does not say how points failed")
    if not same:
        shown = documents.sealed(layout, (), {})
        require_same_shapes(files, metadata.arrays_among(shown))
        examine(files, None)
        return root
    names = [key.removesuffix(f"/{FILE}") for key in files if key.startswith(_NUMBERS)]
    names = [name for name in names if f"{name}/{FILE}" in files.entries and name.count("/") == 1]
    names = [name for name in names if name.partition("/")[2] not in layout.coordinates]
    if len(names) > MOST_NUMBERS:
        raise CorruptStore(f"{source} has more numbers of a point than there can be")
    expected = json.loads(metadata.serialise(documents.sealed(layout, (), {})[FILE]["attributes"]))
    require_alike(root, expected | dict.fromkeys(_OWN), set(_OWN))
    found = documents.sealed(_as_stored(layout, root), names, root)
    others = {FAILURES: _failures, REASONS: _texts, RESULTS: _objects}
    given = Expected(
        dict(metadata.serialised(found)), metadata.arrays_among(found), (_SECTIONS,), others
    )
    examine(files, given)
    return root


def require_documents(content: Packed, layout: StudyLayout) -> None:
    """Raise `CorruptStore` if documents of a running study are not those that the job gives."""
    try:
        root = json.loads(content.read(FILE))["attributes"]
        expected = documents.running(layout)[FILE]["attributes"]
        require_alike(root, json.loads(metadata.serialise(expected)), {"layout"})
        made = metadata.serialised(documents.running(_as_stored(layout, root)))
        wrong = [key for key, one in made if content.read(key) != one]
    except (*ODD, FileNotFoundError) as error:
        raise CorruptStore(f"{DOCUMENTS} cannot be read: {error}") from error
    if wrong:
        raise CorruptStore(f"{wrong[0]} of {DOCUMENTS} is not the document that the job has")


def _as_stored(layout: StudyLayout, root: Mapping[str, Any]) -> StudyLayout:
    """Return a layout with what a store says of itself, in last bits of another machine."""
    digest = root["layout"]
    if not (isinstance(digest, str) and _DIGEST.fullmatch(digest)):
        raise CorruptStore("there is no digest of a layout")
    made = replace(layout, attributes={name: root[name] for name in layout.attributes})
    vars(made)["digest"] = digest
    return made


def _failures(content: bytes) -> None:
    for point, (code, detail, time) in json.loads(content).items():
        if not (int(point) >= 0 and type(code) is type(detail) is str):
            raise CorruptStore("a failed point has no reason")
        if time is not None:
            float(time)


def _texts(content: bytes) -> None:
    if not all(int(point) >= 0 and isinstance(one, str) for point, one in _items(content)):
        raise CorruptStore("a ground is no text")


def _objects(content: bytes) -> None:
    if not all(int(point) >= 0 and isinstance(one, dict) for point, one in _items(content)):
        raise CorruptStore("a result is no object")


def _items(content: bytes) -> list[tuple[str, Any]]:
    return [*json.loads(content).items()]
