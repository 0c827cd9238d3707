"""Documents as JSON, which is made piece by piece as the client takes it if it is long."""

import secrets
from collections.abc import Iterable, Iterator, Mapping
from typing import Any, Final

import numpy as np
from fastapi import Response
from numpy.typing import NDArray
from pydantic import BaseModel
from pydantic_core import to_json
from starlette.types import Receive, Scope, Send

from jointplay.service.pieces import BUDGET, LONGEST
from jointplay.service.streamed import Streamed

LEAST: Final = 50_000
"""Values: fewer are one piece anyway."""
_PART: Final = 8192  # values
_MARK: Final = secrets.token_hex(16)
"""Stands where values come; no text of a client's own has it."""
_JSON: Final = "application/json"


class Parts:
    """Values of a list of which a part at a time is read or made, while the answer is sent.

    Parameters
    ----------
    made
        Arrays or lists, one after the other.
    size
        Numbers in all of them.
    nbytes
        Bytes from which they are made.
    """

    def __init__(self, made: Iterable[Any], size: int, nbytes: int = 0) -> None:
        self.made, self.size, self.nbytes = made, size, nbytes


Column = NDArray[Any] | Parts


class _Streamed(Streamed):
    """An answer for which room must be found first."""

    def __init__(self, pieces: Iterator[bytes], held: int, headers: Mapping[str, str] | None):
        super().__init__(pieces, 200, headers, _JSON)
        self._held = held

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Send it; RequestRefused where many others are being sent."""
        BUDGET.take(scope, self._held)
        await super().__call__(scope, receive, send)


def as_json(document: BaseModel, headers: Mapping[str, str] | None = None) -> Response:
    """Return a document as JSON, of which nothing is validated; NaN becomes null.

    Lists of numbers may be arrays, and lists of anything `Parts`.
    """
    columns: list[Column] = []

    def mark(column: object) -> str:
        if not isinstance(column, np.ndarray | Parts):
            raise TypeError(f"{type(column)} is no column")
        columns.append(column)
        return _MARK

    text = document.__pydantic_serializer__.to_json(document, fallback=mark, warnings=False)
    pieces = _pieces(text.split(f'"{_MARK}"'.encode()), columns)
    if sum(one.size for one in columns) <= LEAST:
        return Response(b"".join(pieces), 200, headers, _JSON)
    return _Streamed(pieces, sum(one.nbytes for one in columns), headers)


def _pieces(between: list[bytes], columns: list[Column]) -> Iterator[bytes]:
    piece = bytearray(between[0])
    for column, behind in zip(columns, between[1:], strict=True):
        separator = b"["
        for part in _parts(column):
            piece += separator + to_json(part, inf_nan_mode="null")[1:-1]
            separator = b","
            if len(piece) >= LONGEST:
                yield bytes(piece)
                piece.clear()
        piece += (b"[]" if separator == b"[" else b"]") + behind
    yield bytes(piece)


def _parts(column: Column) -> Iterator[list[Any]]:
    """Yield lists of a bounded length; none is empty."""
    for part in column.made if isinstance(column, Parts) else [column]:
        for begin in range(0, len(part), _PART):
            values = part[begin : begin + _PART]
            yield values.tolist() if isinstance(values, np.ndarray) else values
