"""A line of the log for every request, where the log is made of JSON objects."""

import logging
import re
import secrets
import time
from typing import Final

from starlette.types import ASGIApp, Message, Receive, Scope, Send

from jointplay.records.log_lines import about, note

_HEADER: Final = b"x-request-id"
_GIVEN: Final = re.compile(rb"[A-Za-z0-9._-]{1,64}")
_log = logging.getLogger(__name__)


class RequestLog:
    """Writes method, route, status and seconds of a request when its answer has ended.

    The id of the request is the proxy's `X-Request-Id`, if that is 1 to 64 of A-Z, a-z, 0-9 and
    . _ -, or a new one. It is in the answer, and in every line that is written for the request. The
    route is the template of the path: paths of signed links would open what they name.
    """

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass a request on, and look at its answer."""
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        began = time.monotonic()
        status = 500  # of an error that the application does not answer
        given = dict(scope["headers"]).get(_HEADER, b"")
        request = given if _GIVEN.fullmatch(given) else secrets.token_hex(8).encode()

        async def noted(message: Message) -> None:
            nonlocal status
            if message["type"] == "http.response.start":
                status = message["status"]
                message["headers"] = [*message["headers"], (_HEADER, request)]
            await send(message)

        note(request=request.decode())  # each request is a task of its own
        try:
            await self._app(scope, receive, noted)
        finally:
            route = getattr(scope.get("route"), "path", None)
            seconds = round(time.monotonic() - began, 6)
            job = scope.get("path_params", {}).get("job_id")
            with about(method=scope["method"], route=route, status=status, seconds=seconds):
                if job is not None:
                    note(job=job)
                _log.info("%s %s %d", scope["method"], route, status)
