"""NumPy's archive: an array a column, ``units`` as pairs of name and unit, ``complete``."""

import io
from collections.abc import Sequence
from typing import Any, Final

import numpy as np

from jointplay.records.table_files.column import Column, apart

SUFFIXES = (".npz",)
MEDIA_TYPE = "application/x-npz"
NEEDS = None
_TAKEN: Final = ("units", "complete", "file")
"""By our own arrays, and by an argument of NumPy's writer."""


def encode(columns: Sequence[Column], *, complete: bool) -> bytes:
    """Return the archive; no pickled object is in it."""
    file = io.BytesIO()
    columns = apart(columns, _TAKEN)
    named: dict[str, Any] = {column.label: column.values for column in columns}
    units = np.array([[column.label, column.unit] for column in columns])
    np.savez(file, **named, units=units, complete=np.array(complete))
    return file.getvalue()
