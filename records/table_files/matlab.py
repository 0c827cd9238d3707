"""MATLAB's file: channel ``slider7.x`` is the field ``x`` of the variable ``slider7``."""

import io
import re
from collections.abc import Sequence
from typing import Any, Final, cast

from jointplay.records.table_files.column import Column

SUFFIXES = (".mat",)
MEDIA_TYPE = "application/x-matlab-data"
NEEDS = None
_LONGEST_FIELD: Final = 63  # of a name in MATLAB
_OF_A_PARENT: Final = "value"
"""Where a column is whose name is that of a struct as well."""
_OURS: Final = ("units", "complete")


def encode(columns: Sequence[Column], *, complete: bool) -> bytes:
    """Return nested structs of columns, ``units`` likewise, and ``complete``."""
    from scipy.io import savemat  # loads much of scipy

    values: dict[str, Any] = {}
    units: dict[str, Any] = {}
    paths = _paths(list(dict.fromkeys(column.name for column in columns)))
    for column in columns:
        path = paths[column.name]
        shown = column.values if column.is_number else column.values.astype(object)
        _place(values, [*path, column.part] if column.part else path, shown.reshape(-1, 1))
        _place(units, path, column.unit)
    file = io.BytesIO()
    document = values | {"units": units, "complete": complete}
    savemat(cast(Any, file), document, long_field_names=True, oned_as="column")
    return file.getvalue()


def _paths(names: Sequence[str]) -> dict[str, list[str]]:
    """Return where each column is, so that no two are in one place: they are numbered."""
    wanted = {name: [_field(part) for part in name.split(".")] for name in names}
    nodes = {tuple(path[:end]) for path in wanted.values() for end in range(1, len(path))}
    known = {(name,) for name in _OURS} | nodes
    found = {}
    for name in sorted(names, key=lambda name: tuple(wanted[name]) in nodes):
        path, number = wanted[name], 1
        if tuple(path) in nodes:
            path = [*path, _OF_A_PARENT]
        if path[0] in _OURS:
            path = [_numbered(path[0], 2), *path[1:]]
        own = path
        while tuple(own) in known:
            number += 1
            own = [*path[:-1], _numbered(path[-1], number)]
        known.add(tuple(own))
        found[name] = own
    return found


def _place(tree: dict[str, Any], path: Sequence[str], leaf: object) -> None:
    *parents, last = path
    for parent in parents:
        tree = tree.setdefault(parent, {})
    tree[last] = leaf


def _field(name: str) -> str:
    """Make a name that MATLAB takes."""
    field = re.sub(r"\W", "_", name, flags=re.ASCII)
    return (field if field[:1].isalpha() else f"x{field}")[:_LONGEST_FIELD]


def _numbered(field: str, number: int) -> str:
    end = f"_{number}"
    return f"{field[: _LONGEST_FIELD - len(end)]}{end}"
