"""Clients that hold connections, heads, bodies and answers for nothing."""

from collections.abc import Iterator
from contextlib import contextmanager
from random import Random
from typing import Final

from jointplay.chaos.faults.fault import Fault
from jointplay.chaos.held_connections import HALF_A_HEAD, MANY_ANSWERS, NOTHING, HeldConnections
from jointplay.chaos.installation import LEASE, Installation

_BODY: Final = (
    b"POST /v1/batches HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Type: application/json\r\n"
    b"Content-Length: 33000000\r\n\r\n[" + b" " * 1_000_000
)
_SENT: Final = [NOTHING] * 300 + [HALF_A_HEAD] * 100 + [MANY_ANSWERS] * 50 + [_BODY] * 20


class ConnectionsHeld(Fault):
    """300 connections without a word, 100 heads and 20 bodies without an end, 50 deaf readers."""

    lasts = (LEASE / 2, 2.5 * LEASE)

    @contextmanager
    def strike(self, installation: Installation, drawn: Random) -> Iterator[None]:
        """Hold them, and open again what the service closes."""
        with HeldConnections(installation.url, drawn.sample(_SENT, len(_SENT))):
            yield
