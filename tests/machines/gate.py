"""A gate before the S3 server: it passes everything on, or answers everything with 503."""

import asyncio

from tests.machines.network import Port
from tests.machines.passing import Passing, Streams, passed_on, refused

_REFUSAL = b"HTTP/1.1 503 Slow Down\r\nContent-Length: 0\r\nConnection: close\r\n\r\n"


class Gate(Passing):
    """Stands on the machine of a server.

    Parameters
    ----------
    port
        Where it listens.
    server
        Port number of the server there.
    """

    def __init__(self, port: Port, server: int) -> None:
        self._server = server
        self._passing: set[asyncio.Task[None]] = set()
        self._refuses = False
        super().__init__(port)

    def refuse(self) -> None:
        """Cut what is on its way, and answer with 503 from now on."""
        self._loop.call_soon_threadsafe(self._cut)

    def pass_on(self) -> None:
        """Pass everything on again."""
        self._refuses = False

    def _cut(self) -> None:
        self._refuses = True
        for one in self._passing:
            one.cancel()

    async def answer(self, here: Streams) -> None:
        """Pass a connection on, or refuse what it asks for."""
        if self._refuses:
            await refused(here, _REFUSAL)
            return
        task = asyncio.current_task()
        assert task is not None
        self._passing.add(task)
        try:
            there = await asyncio.open_connection(self._port.address, self._server)
            await passed_on(here, there)
        finally:
            self._passing.discard(task)
