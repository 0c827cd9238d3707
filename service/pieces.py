"""Long answers go in pieces: the next one when the client has taken the one before."""

from typing import Final

from starlette.types import ASGIApp, Message, Receive, Scope, Send

LONGEST: Final = 64 * 1024
"""Bytes of a piece: as many wait for a client that takes nothing, beside the answer itself."""


class Pieces:
    """Cuts bodies that are longer."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass a request on, and its answer in pieces."""

        async def cut(message: Message) -> None:
            body = message.get("body", b"")
            if message["type"] != "http.response.body" or len(body) <= LONGEST:
                await send(message)
                return
            view, more = memoryview(body), message.get("more_body", False)
            for begin in range(0, len(view), LONGEST):
                piece = bytes(view[begin : begin + LONGEST])
                last = begin + LONGEST >= len(view)
                await send({**message, "body": piece, "more_body": more or not last})

        await self._app(scope, receive, cut)
