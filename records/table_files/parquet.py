"""Parquet: the table of Arrow's stream, compressed."""

import io
from collections.abc import Sequence

from jointplay.records.table_files.arrow import table_of
from jointplay.records.table_files.column import Column

SUFFIXES = (".parquet",)
MEDIA_TYPE = "application/vnd.apache.parquet"
NEEDS = "pyarrow"


def encode(columns: Sequence[Column], *, complete: bool) -> bytes:
    """Return the file, with units and ``complete`` as metadata."""
    from pyarrow import parquet  # is there only with the extra

    file = io.BytesIO()
    parquet.write_table(table_of(columns, complete=complete), file)
    return file.getvalue()
