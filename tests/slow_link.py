"""A link that takes a limited number of bytes a second, or none, between a client and a server."""

import socket
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress

_AT_ONCE = 2**18


@contextmanager
def slow_link(host: str, port: int, rate: float) -> Iterator[int]:
    """Yield a port of this machine; `rate` : bytes a second to the server, 0: none."""
    with socket.create_server(("127.0.0.1", 0)) as listening:
        accepting = threading.Thread(target=_accept, args=(listening, (host, port), rate))
        accepting.start()
        try:
            yield listening.getsockname()[1]
        finally:
            listening.shutdown(socket.SHUT_RDWR)
            accepting.join()


def _accept(listening: socket.socket, server: tuple[str, int], rate: float) -> None:
    with suppress(OSError):
        while True:
            client, _ = listening.accept()
            client.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, _AT_ONCE)
            there = socket.create_connection(server)
            threading.Thread(target=_pass, args=(client, there, rate), daemon=True).start()
            threading.Thread(target=_pass, args=(there, client, 1e9), daemon=True).start()


def _pass(source: socket.socket, target: socket.socket, rate: float) -> None:
    with source, target, suppress(OSError):
        while rate:
            some = source.recv(_AT_ONCE)
            if not some:
                return
            target.sendall(some)
            time.sleep(len(some) / rate)
        threading.Event().wait(60.0)  # longer than any test waits
