"""Arrow's stream: a column a quantity, with its ``unit`` as metadata."""

from collections.abc import Callable, Sequence
from typing import Any

from jointplay.records.table_files.column import Column

SUFFIXES = (".arrows",)
MEDIA_TYPE = "application/vnd.apache.arrow.stream"
NEEDS = "pyarrow"


def encode(columns: Sequence[Column], *, complete: bool) -> bytes:
    """Return the stream; ``complete`` is metadata of its schema."""
    import pyarrow  # is there only with the extra

    return written(pyarrow.ipc.new_stream, table_of(columns, complete=complete))


def written(new: Callable[..., Any], table: Any) -> bytes:
    """Return what one of pyarrow's writers makes of a table."""
    import pyarrow

    made = pyarrow.BufferOutputStream()
    with new(made, table.schema) as writer:
        writer.write_table(table)
    return bytes(made.getvalue())


def table_of(columns: Sequence[Column], *, complete: bool) -> Any:
    """Return a table of pyarrow: doubles, or words."""
    import pyarrow

    types = [pyarrow.float64() if one.is_number else pyarrow.string() for one in columns]
    fields = [
        pyarrow.field(column.label, kind, metadata={"unit": column.unit})
        for column, kind in zip(columns, types, strict=True)
    ]
    schema = pyarrow.schema(fields, metadata={"complete": str(complete).lower()})
    arrays = [
        pyarrow.array(column.values if column.is_number else column.values.tolist(), kind)
        for column, kind in zip(columns, types, strict=True)
    ]
    return pyarrow.table(arrays, schema=schema)
