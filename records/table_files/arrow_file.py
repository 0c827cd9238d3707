"""Arrow's file, also called Feather: what `arrow` writes as a stream, with a table of contents."""

from collections.abc import Sequence

from jointplay.records.table_files.arrow import table_of, written
from jointplay.records.table_files.column import Column

SUFFIXES = (".arrow", ".feather")
MEDIA_TYPE = "application/vnd.apache.arrow.file"
NEEDS = "pyarrow"


def encode(columns: Sequence[Column], *, complete: bool) -> bytes:
    """Return the file; ``complete`` is metadata of its schema."""
    import pyarrow  # is there only with the extra

    return written(pyarrow.ipc.new_file, table_of(columns, complete=complete))
