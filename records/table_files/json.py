"""JSON: columns by name, each with its unit; null for what is not finite."""

import json
from collections.abc import Sequence
from typing import Any

import numpy as np

from jointplay.records.table_files.column import Column

SUFFIXES = (".json",)
MEDIA_TYPE = "application/json"
NEEDS = None


def encode(columns: Sequence[Column], *, complete: bool) -> bytes:
    """Return ``{"complete", "columns": {name: {"unit", "values"}}}``."""
    named = {one.label: {"unit": one.unit, "values": _values(one)} for one in columns}
    return (json.dumps({"complete": complete, "columns": named}, allow_nan=False) + "\n").encode()


def _values(column: Column) -> list[Any]:
    if column.values.dtype.kind != "f":
        return list(column.values.tolist())
    values = column.values.tolist()
    return [
        value if finite else None
        for value, finite in zip(values, np.isfinite(column.values), strict=True)
    ]
