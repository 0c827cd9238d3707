"""Answers that are sent while they are made or read: one that cannot go on ends too early."""

import logging

from fastapi.responses import StreamingResponse
from starlette.types import Receive, Scope, Send

from jointplay.storage.errors import CorruptStore

_log = logging.getLogger(__name__)


class Streamed(StreamingResponse):
    """An answer in pieces, of which the first ones may be sent when a bucket or a disk fails.

    Its end is never sent then, and the connection is closed: the client sees that bytes are
    missing. The log has a line that says why.
    """

    _asked = ""

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Send it."""
        # not the path, which opens what a signed link names
        self._asked = f"{scope['method']} {getattr(scope.get('route'), 'path', 'a request')}"
        await super().__call__(scope, receive, send)

    async def stream_response(self, send: Send) -> None:
        """Send what can be had."""
        try:
            await super().stream_response(send)
        except (OSError, CorruptStore) as fault:
            _log.warning("%s: the answer ended too early: %s", self._asked, fault)
