"""Tables and numbers as text: comma-separated values, and JSON in pieces."""

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

_FORMATS: Final = {"f": "%.17g", "i": "%d", "u": "%d", "b": "%d", "U": "%s"}
"""By kind of dtype; 17 significant digits give back every bit of a double, NaN is ``nan``."""


def csv_lines(
    titles: Sequence[str],
    blocks: Iterable[Sequence[NDArray[Any] | Sequence[Any]]],
    comments: Iterable[str] = (),
) -> Iterator[str]:
    """Write a table as comma-separated values, block by block.

    Parameters
    ----------
    titles
        Of the columns.
    blocks
        Consecutive rows: of each block the columns, all of one length.
    comments
        Text for lines that begin with `#`, before the titles.

    Yields
    ------
    str
        Whole lines.
    """
    for comment in comments:
        for line in comment.splitlines() or [""]:
            yield f"# {line}".rstrip() + "\n"
    yield ",".join(map(_cell, titles)) + "\n"
    for block in blocks:
        columns = [_quoted(np.asarray(column)) for column in block]
        row = ",".join([_FORMATS[column.dtype.kind] for column in columns]) + "\n"
        values = zip(*(column.tolist() for column in columns), strict=True)
        if text := "".join([row % one for one in values]):
            yield text


def _quoted(column: NDArray[Any]) -> NDArray[Any]:
    """Return a column of text as cells."""
    if column.dtype.kind != "U":
        return column
    return np.array([_cell(word) for word in column.tolist()])


def _cell(word: str) -> str:
    """Put quotes about text that would be cut elsewhere (RFC 4180)."""
    return '"' + word.replace('"', '""') + '"' if {*word} & {*',"\r\n'} else word


def json_numbers(values: NDArray[np.float64]) -> str:
    """Write numbers between commas, every bit of them; null for NaN, which JSON has not."""
    return ", ".join([repr(one) if np.isfinite(one) else "null" for one in values.tolist()])


def json_object(members: Mapping[str, Iterable[str]]) -> Iterator[str]:
    """Write an object whose members are JSON text in pieces."""
    yield "{"
    for position, (name, pieces) in enumerate(members.items()):
        yield f"{', ' if position else ''}{json.dumps(name)}: "
        yield from pieces
    yield "}"


def json_list(items: Iterable[str]) -> Iterator[str]:
    """Write a list of items that are JSON text."""
    yield "["
    for position, item in enumerate(items):
        yield f", {item}" if position else item
    yield "]"
