"""Connections that are held for nothing, and opened again when a service closes them."""

import select
import socket
import threading
import time
from collections.abc import Sequence
from contextlib import suppress
from typing import Final, Self
from urllib.parse import urlsplit

ASKED: Final = b"GET /openapi.json HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n"
NOTHING: Final = b""
HALF_A_HEAD: Final = ASKED[:-2] + b"X-Half: "
MANY_ANSWERS: Final = 20 * ASKED
"""More than the system keeps for a client that takes none of them."""
_PAUSE: Final = 5.0  # s
_LITTLE: Final = 4096  # bytes


class HeldConnections(threading.Thread):
    """Holds connections, until it is told to end.

    Parameters
    ----------
    url
        Of the service.
    sent
        What is sent over each, once; nothing is read.
    """

    def __init__(self, url: str, sent: Sequence[bytes]) -> None:
        super().__init__(name="held connections", daemon=True)
        parts = urlsplit(url)
        self._address = str(parts.hostname), int(parts.port or 80)
        self._sent = sent
        self._held: dict[int, tuple[socket.socket, bytes]] = {}
        self._ended = select.poll()
        self._begun, self._over = threading.Event(), threading.Event()
        self.again = 0

    def run(self) -> None:
        """Open all, and what is closed again."""
        for sent in self._sent:
            if not self._over.is_set():
                self._open(sent)
        self._begun.set()
        due = time.monotonic() + _PAUSE
        while not self._over.wait(0.1):
            self.look()
            if time.monotonic() > due:
                self._open_again()
                due = time.monotonic() + _PAUSE
        for one, _ in self._held.values():
            one.close()

    def look(self) -> None:
        """Look at the service, every tenth of a second."""

    def _open_again(self) -> None:
        for number, _ in self._ended.poll(0):
            self.again += 1
            self._ended.unregister(number)
            one, sent = self._held.pop(number)
            one.close()
            self._open(sent)

    def _open(self, sent: bytes) -> None:
        one = socket.socket()
        if sent == MANY_ANSWERS:
            one.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, _LITTLE)
        one.settimeout(10.0)
        with suppress(OSError):  # it may be closed at once
            one.connect(self._address)
            one.setblocking(False)
            one.send(sent)
        self._held[one.fileno()] = one, sent
        self._ended.register(one, select.POLLRDHUP)

    def __enter__(self) -> Self:
        self.start()
        self._begun.wait()
        return self

    def __exit__(self, *_: object) -> None:
        self._over.set()
        self.join()
