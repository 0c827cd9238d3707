"""Results of a run that another program sealed, against the layout that the job gives."""

import json
from collections.abc import Mapping
from dataclasses import replace
from math import prod
from pathlib import Path
from typing import Any, Final

from jointplay.storage.errors import CorruptStore
from jointplay.storage.packed.ranges import Ranges
from jointplay.storage.packed.reading import Packed
from jointplay.storage.packed.running import Running
from jointplay.storage.results import metadata
from jointplay.storage.results.certificate_group import CERTIFICATE
from jointplay.storage.results.examination import (
    ODD,
    Expected,
    examine,
    opened,
    require_alike,
    require_same_shapes,
)
from jointplay.storage.results.growing_table import GrowingTable
from jointplay.storage.results.intervals import intervals_table
from jointplay.storage.results.layout import ResultLayout
from jointplay.storage.results.metadata import DOUBLE, FILE, Document
from jointplay.storage.results.pyramid import GROUP as PYRAMID
from jointplay.storage.results.pyramid import Pyramid
from jointplay.storage.results.steps import steps_table
from jointplay.storage.results.tables import documents, tables
from jointplay.storage.results.wide_table import WideTable

_COUNTS: Final = ("samples", "sections", "impacts")
_OWN: Final = frozenset({*_COUNTS, "complete", "summary"})
"""Attributes that the layout does not know."""
_MOST_CERTIFIED: Final = 2**20
"""Values of an array of a certificate, and arrays in its group, at most."""
_MOST_ARRAYS: Final = 64
_FILES_OF_A_CHANNEL: Final = 16


def examined_run(source: Ranges, layout: ResultLayout, *, same: bool) -> Document:
    """Read a whole store, and return the attributes of its root.

    Parameters
    ----------
    source
        Its bytes.
    layout
        That the job gives.
    same
        Whether the solver that sealed it is of the version that gave the layout. Of another one
        names, shapes and types of what both have are compared, documents and chunks are not.

    Raises
    ------
    CorruptStore
        It is not whole, or no store of this layout.
    """
    rows = layout.samples + layout.sections
    files, root = opened(source, _FILES_OF_A_CHANNEL * (len(layout.channels) + 100) + rows)
    _require_counts(layout, root)
    if not same:
        require_same_shapes(files, metadata.arrays_among(_documents(layout, root, {})))
        examine(files, None)
        return root
    try:
        more = _certificate(files)
        inside = _internal(files, layout)
    except (*ODD, FileNotFoundError) as error:
        raise CorruptStore(f"{source} has odd documents: {error}") from error
    require_alike(root, json.loads(_root(layout)), set(_OWN))
    own = {name: root[name] for name in layout.attributes}
    found = inside | _documents(replace(layout, attributes=own), root, more)
    partial = () if root["complete"] else (f"{PYRAMID}/",)
    examine(
        files, Expected(dict(metadata.serialised(found)), metadata.arrays_among(found), partial)
    )
    return root


def _require_counts(layout: ResultLayout, root: Mapping[str, Any]) -> None:
    """Raise `CorruptStore` if a store has other numbers of rows than the job may give."""
    complete, summary = root.get("complete"), root.get("summary")
    if not (isinstance(complete, bool) and isinstance(summary, dict)):
        raise CorruptStore("the root does not say how the run ended")
    samples, sections, _ = (_count(root.get(name)) for name in _COUNTS)
    most = layout.samples, layout.sections
    if (samples, sections) != most if complete else samples > most[0] or sections > most[1]:
        raise CorruptStore(
            f"{samples} samples and {sections} sections are stored; the job has {most[0]} and"
            f" {most[1]}"
        )


def _documents(
    layout: ResultLayout, root: Mapping[str, Any], more: Mapping[str, Document]
) -> dict[str, Document]:
    shown = [*(root[name] for name in _COUNTS), len(layout.channels)]
    attributes = {name: root[name] for name in ("complete", *_COUNTS, "summary")}
    return documents(layout, shown, attributes, more)


def _root(layout: ResultLayout) -> bytes:
    """Return the attributes that a layout gives, with any that it does not know."""
    made = documents(layout, [0, 0, 0, 0], dict.fromkeys(_OWN))[FILE]["attributes"]
    return metadata.serialise(made)


def _internal(files: Packed, layout: ResultLayout) -> dict[str, Document]:
    """Make the documents of arrays that clients are not shown, as long as those of the store."""
    nothing = Running(Path())
    history = GrowingTable(tables(layout)[0], nothing)
    made = Pyramid(layout, history, nothing).documents()
    wide: list[WideTable] = []
    if layout.steps:
        wide.append(steps_table(layout, nothing))
    if layout.intervals:
        wide.append(intervals_table(layout, nothing))
    for table in wide:
        key, _ = table.document()
        table.rows = _count(json.loads(files.read(key))["shape"][0])
        made |= dict([table.document()])
    return made


def _certificate(files: Packed) -> dict[str, Document]:
    """Make the nodes of the group of a certificate, with shapes and words of the store."""
    begin, end = f"{CERTIFICATE}/", f"/{FILE}"
    if f"{CERTIFICATE}{end}" not in files.entries:
        return {}
    arrays: dict[str, Document] = {}
    for key in files:
        name = key.removeprefix(begin).removesuffix(end)
        if key != f"{begin}{name}{end}":
            continue
        found = json.loads(files.read(key))
        shape = [_count(length) for length in found["shape"]]
        if prod(shape) > _MOST_CERTIFIED or len(arrays) == _MOST_ARRAYS:
            raise CorruptStore(f"{files.source} has more of a certificate than there can be")
        arrays[name] = metadata.array(
            shape,
            [max(length, 1) for length in shape],
            DOUBLE,
            found["dimension_names"],
            found["attributes"],
        )
    attributes = json.loads(files.read(f"{CERTIFICATE}{end}"))["attributes"]
    below = {f"{begin}{name}": one for name, one in arrays.items()}
    return {CERTIFICATE: metadata.group(attributes, arrays), **below}


def _count(length: object) -> int:
    if type(length) is not int or length < 0:
        raise CorruptStore(f"{length!r} is no number of rows")
    return length
