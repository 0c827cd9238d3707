"""Targets of requests, and requests with two ends, as RFC 9112 has them.

A target may name the whole address (section 3.2.2). A request with two lengths, as in attacks by
what passes a proxy unseen (section 6.3), is refused, and its connection ends with it.
"""

from typing import Final
from urllib.parse import unquote

from starlette.requests import Request
from starlette.types import ASGIApp, Receive, Scope, Send

from jointplay.service.problems import RequestRefused, kinds
from jointplay.service.problems.handlers import answer

_SCHEMES: Final = (b"http://", b"https://")
_LENGTHS: Final = frozenset({b"content-length", b"transfer-encoding"})


class Targets:
    """Passes requests on with the path of their target, and its host in place of their header's."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass a request on, or refuse it."""
        if scope["type"] == "http":
            if {name for name, _ in scope["headers"]} >= _LENGTHS:
                sentence = "The request has both a Content-Length and a Transfer-Encoding."
                closing = {"Connection": "close"}
                refused = RequestRefused(kinds.NO_REQUEST, sentence, headers=closing)
                await (await answer(Request(scope), refused))(scope, receive, send)
                return
            if scope.get("raw_path", b"").lower().startswith(_SCHEMES):
                _take_host(scope)
        await self._app(scope, receive, send)


def _take_host(scope: Scope) -> None:
    """Have the scope of a request whose target is a whole address be that of its path there."""
    host, slash, path = scope["raw_path"].partition(b"://")[2].partition(b"/")
    raw_path = b"/" + path if slash else b"/"
    others = [(name, value) for name, value in scope["headers"] if name != b"host"]
    headers = [(b"host", host), *others]
    found = unquote(raw_path.decode("ascii"))
    scope.update({"path": found, "raw_path": raw_path, "headers": headers})
