"""Long answers go in pieces: the next one when the client has taken the one before.

Until a client has taken all, the answer is in memory: those that are share `MOST_TOGETHER` bytes.
"""

from collections.abc import Iterator
from typing import Final

from starlette.datastructures import Headers
from starlette.requests import Request
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from jointplay.service.problems import unavailable
from jointplay.service.problems.handlers import answer

LONGEST: Final = 64 * 1024
"""Bytes of a piece: as many wait for a client that takes nothing, beside the answer itself."""
MOST_TOGETHER: Final = 64 * 1024 * 1024
"""Bytes of all longer answers that wait for their clients, if they are several."""
RETRY: Final = 5
"""Seconds after which a client whose answer found no room may ask again."""


class Pieces:
    """Cuts bodies that are longer, and refuses with 503 what is too much together."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app
        self._held = 0

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass a request on, and its answer in pieces."""
        start: Message | None = None
        held, refused = 0, False

        async def cut(message: Message) -> None:
            nonlocal start, held, refused
            if refused:
                return
            if message["type"] == "http.response.start" and _is_long(message):
                start = message  # goes with the body, if there is room for that
                return
            body = message.get("body", b"")
            if start is not None:
                if len(body) > LONGEST and self._held and self._held + len(body) > MOST_TOGETHER:
                    refused = True
                    problem = unavailable("Many long answers wait for their clients.", RETRY)
                    await (await answer(Request(scope), problem))(scope, receive, send)
                    return
                if len(body) > LONGEST:
                    held += len(body)
                    self._held += len(body)
                await send(start)
                start = None
            if len(body) <= LONGEST:
                await send(message)
                return
            for piece in _pieces(message):
                await send(piece)

        try:
            await self._app(scope, receive, cut)
        finally:
            self._held -= held


def _is_long(start: Message) -> bool:
    length = Headers(raw=start["headers"]).get("content-length", "")
    return length.isdecimal() and int(length) > LONGEST


def _pieces(message: Message) -> Iterator[Message]:
    view, more = memoryview(message["body"]), message.get("more_body", False)
    for begin in range(0, len(view), LONGEST):
        piece = bytes(view[begin : begin + LONGEST])
        last = begin + LONGEST >= len(view)
        yield {**message, "body": piece, "more_body": more or not last}
