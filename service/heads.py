"""HEAD at every address that knows GET: its answer without the body (RFC 9110, section 9.3.2)."""

from collections.abc import Sequence

from starlette.routing import BaseRoute, Match
from starlette.types import ASGIApp, Message, Receive, Scope, Send


class Heads:
    """Has GET answer a HEAD, of which the head is sent at once, and nothing else.

    Parameters
    ----------
    known
        Routes that answer a HEAD themselves, since they need not read what GET sends.
    """

    def __init__(self, app: ASGIApp, known: Sequence[BaseRoute]) -> None:
        self._app, self._known = app, known

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass a request on."""
        if scope["type"] != "http" or scope["method"] != "HEAD" or self._knows(scope):
            await self._app(scope, receive, send)
            return

        async def head(message: Message) -> None:
            if message["type"] == "http.response.start":
                await send(message)
                await send({"type": "http.response.body"})  # a stream ends with its client

        asked = {**scope, "method": "GET"}
        try:
            await self._app(asked, receive, head)
        finally:
            scope.update({**asked, "method": "HEAD"})  # the log tells the route

    def _knows(self, scope: Scope) -> bool:
        return any(route.matches(scope)[0] is Match.FULL for route in self._known)
