"""Answers to errors that nobody expected, inside of all that gives every answer its headers.

Starlette answers them outside of every middleware: such an answer has no content policy, and not
the id of its request, by which its line in the log is found.
"""

from starlette.requests import Request
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from jointplay.service.problems.handlers import answer


class UnexpectedErrors:
    """Answers an error by its problem document, unless an answer has begun."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass a request on."""
        begun = False

        async def noted(message: Message) -> None:
            nonlocal begun
            begun = True
            await send(message)

        try:
            await self._app(scope, receive, noted)
        except Exception as error:
            if begun or scope["type"] != "http":
                raise
            response = await answer(Request(scope, receive), error)
            await response(scope, receive, send)
