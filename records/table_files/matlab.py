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


def encode(columns: Sequence[Column], *, complete: bool) -> bytes:
    """Return nested structs of columns, ``units`` likewise, and ``complete``."""
    from scipy.io import savemat  # loads much of scipy

    values: dict[str, Any] = {}
    units: dict[str, Any] = {}
    for column in columns:
        path = [*column.name.split("."), *([column.part] if column.part else [])]
        is_number = column.is_number
        shown = column.values if is_number else column.values.astype(object)
        _place(values, path, shown.reshape(-1, 1))
        _place(units, column.name.split("."), column.unit)
    file = io.BytesIO()
    document = values | {"units": units, "complete": complete}
    savemat(cast(Any, file), document, long_field_names=True, oned_as="column")
    return file.getvalue()


def _place(tree: dict[str, Any], path: list[str], leaf: object) -> None:
    """Put a leaf at a path; where a node is a leaf as well, that goes into its `value`."""
    *parents, last = (_field(part) for part in path)
    for parent in parents:
        below = tree.setdefault(parent, {})
        if not isinstance(below, dict):
            below = tree[parent] = {_OF_A_PARENT: below}
        tree = below
    if isinstance(tree.get(last), dict):
        tree[last][_OF_A_PARENT] = leaf
    else:
        tree[last] = leaf


def _field(name: str) -> str:
    """Make a name that MATLAB takes."""
    field = re.sub(r"\W", "_", name, flags=re.ASCII)
    return (field if field[:1].isalpha() else f"x{field}")[:_LONGEST_FIELD]
