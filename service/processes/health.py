"""Whether an API that is starting answers: it is asked once, and its answer is looked for."""

import http.client
import select
import socket

_PATIENCE = 1.0  # s, for what the system does at once
_EVERYWHERE = ("0.0.0.0", "::")  # noqa: S104 - compared, not bound


class Health:
    """A request for /healthz, which waits with the listening socket until the API takes it.

    Asking anew every second would need an answer within a second, which a busy machine cannot give.
    """

    def __init__(self, listener: socket.socket) -> None:
        host, port = listener.getsockname()[:2]
        self._address = ("localhost" if host in _EVERYWHERE else host, port)
        self._asked: http.client.HTTPConnection | None = None

    def is_good(self) -> bool:
        """Return whether the API has answered by now."""
        try:
            return self._status() == http.client.OK
        except (OSError, http.client.HTTPException):
            self.close()
            return False

    def close(self) -> None:
        """Leave the request."""
        if self._asked is not None:
            self._asked.close()
            self._asked = None

    def _status(self) -> int | None:
        if self._asked is None:
            self._asked = http.client.HTTPConnection(*self._address, timeout=_PATIENCE)
            self._asked.request("GET", "/healthz")
        readable, _, _ = select.select([self._asked.sock], [], [], 0.0)
        if not readable:
            return None
        status = self._asked.getresponse().status
        self.close()
        return status
