"""NumPy's archive: an array a column, ``units`` as pairs of name and unit, ``complete``."""

import io
from collections.abc import Sequence
from typing import Any

import numpy as np

from jointplay.records.table_files.column import Column

SUFFIXES = (".npz",)
MEDIA_TYPE = "application/x-npz"
NEEDS = None


def encode(columns: Sequence[Column], *, complete: bool) -> bytes:
    """Return the archive; no pickled object is in it."""
    file = io.BytesIO()
    named: dict[str, Any] = {column.label: column.values for column in columns}
    units = np.array([[column.label, column.unit] for column in columns])
    np.savez(file, **named, units=units, complete=np.array(complete))
    return file.getvalue()
