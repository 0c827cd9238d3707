"""Long answers go in pieces: the next one when the client has taken the one before.

Until a client has taken all, the answer is in memory: those that are share `MOST_TOGETHER` bytes.
"""

from collections.abc import Iterator
from typing import Final

from starlette.datastructures import Headers
from starlette.requests import Request
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from jointplay.service.byte_budget import ByteBudget
from jointplay.service.problems import RequestRefused
from jointplay.service.problems.handlers import answer

LONGEST: Final = 64 * 1024
"""Bytes of a piece: as many wait for a client that takes nothing, beside the answer itself."""
MOST_TOGETHER: Final = 64 * 1024 * 1024
"""Bytes of all longer answers, and of what others are made from while they are sent."""
BUDGET: Final = ByteBudget(MOST_TOGETHER, "Many long answers wait for their clients.")


class Pieces:
    """Cuts bodies that are longer, and refuses with 503 what is too much together."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass a request on, and its answer in pieces."""
        start: Message | None = None
        refused = False

        async def cut(message: Message) -> None:
            nonlocal start, refused
            if refused:
                return
            if message["type"] == "http.response.start" and _is_long(message):
                start = message  # goes with the body, if there is room for that
                return
            body = message.get("body", b"")
            if start is not None:
                try:
                    BUDGET.take(scope, len(body) if len(body) > LONGEST else 0)
                except RequestRefused as problem:
                    refused = True
                    await (await answer(Request(scope), problem))(scope, receive, send)
                    return
                await send(start)
                start = None
            if len(body) <= LONGEST:
                await send(message)
                return
            for piece in _pieces(message):
                await send(piece)

        await self._app(scope, receive, cut)


def _is_long(start: Message) -> bool:
    length = Headers(raw=start["headers"]).get("content-length", "")
    return length.isdecimal() and int(length) > LONGEST


def _pieces(message: Message) -> Iterator[Message]:
    view, more = memoryview(message["body"]), message.get("more_body", False)
    for begin in range(0, len(view), LONGEST):
        piece = bytes(view[begin : begin + LONGEST])
        last = begin + LONGEST >= len(view)
        yield {**message, "body": piece, "more_body": more or not last}
