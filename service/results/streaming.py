"""JSON of many values, made piece by piece as the client takes it."""

from collections.abc import Iterable, Iterator, Mapping
from typing import Final

from fastapi.responses import StreamingResponse
from pydantic import BaseModel, TypeAdapter

from jointplay.records.arrays import Floats

LEAST: Final = 50_000
"""Values: fewer are one piece anyway."""
_PIECE: Final = 8192  # values
_EMPTY: Final = '"values":[]'
"""In JSON it is never inside a text, whose quotes have a backslash before them."""
_NUMBERS: Final = TypeAdapter(list[float | None])


def as_stream(
    document: BaseModel, columns: Iterable[Iterable[Floats]], headers: Mapping[str, str]
) -> StreamingResponse:
    """Return a document as `as_json` does, with columns in place of its empty lists of values.

    Parameters
    ----------
    document
        Has as many members `values` as there are columns, in their order, all of them empty.
    columns
        Parts of each, one after the other; read while the answer is sent.
    headers
        Of the answer.
    """
    return StreamingResponse(
        _pieces(document.model_dump_json(), columns), 200, headers, "application/json"
    )


def _pieces(text: str, columns: Iterable[Iterable[Floats]]) -> Iterator[bytes]:
    before, *after = text.split(_EMPTY)
    yield before.encode()
    for parts, behind in zip(columns, after, strict=True):
        yield b'"values":['
        yield from _numbers(parts)
        yield b"]" + behind.encode()


def _numbers(parts: Iterable[Floats]) -> Iterator[bytes]:
    separator = b""
    for part in parts:
        for begin in range(0, len(part), _PIECE):
            yield separator + _NUMBERS.dump_json(part[begin : begin + _PIECE].tolist())[1:-1]
            separator = b","
