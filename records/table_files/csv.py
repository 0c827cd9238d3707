"""Comma-separated values with 17 significant digits, which give back every bit."""

from collections.abc import Sequence

from jointplay.records.table_files.column import Column
from jointplay.records.text_tables import csv_lines

SUFFIXES = (".csv",)
MEDIA_TYPE = "text/csv"
NEEDS = None


def encode(columns: Sequence[Column], *, complete: bool) -> bytes:
    """Return a header row ``time [s],slider7.x [m]`` and one row a sample."""
    del complete  # has no place in a table
    titles = [one.title for one in columns]
    return "".join(csv_lines(titles, [[column.values for column in columns]])).encode()
