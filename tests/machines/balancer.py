"""A balancer before the APIs: what the users of an installation know."""

import asyncio
import ssl
from collections.abc import Sequence
from contextlib import suppress
from itertools import count

from tests.machines.network import Port
from tests.machines.passing import Passing, Streams, passed_on, refused

_CONNECT = 1.0  # s
_ABSENT = b"HTTP/1.1 502 Bad Gateway\r\nContent-Length: 0\r\nConnection: close\r\n\r\n"


class Balancer(Passing):
    """Gives each connection to the next API that can be reached; 502 if there is none.

    Parameters
    ----------
    port
        Where it listens.
    apis
        Address and port number of each.
    certified
        What it encrypts with.
    """

    def __init__(
        self, port: Port, apis: Sequence[tuple[str, int]], certified: ssl.SSLContext
    ) -> None:
        self._apis = apis
        self._turn = count()
        super().__init__(port, certified)

    async def answer(self, here: Streams) -> None:
        """Pass a connection on."""
        turn = next(self._turn)
        for number in range(len(self._apis)):
            address = self._apis[(turn + number) % len(self._apis)]
            with suppress(OSError):  # TimeoutError is one
                there = await asyncio.wait_for(asyncio.open_connection(*address), _CONNECT)
                await passed_on(here, there)
                return
        await refused(here, _ABSENT)
