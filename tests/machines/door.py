"""The address at which the store of the bucket is reached from outside, encrypted."""

import asyncio
import ssl

from tests.machines.network import Port
from tests.machines.passing import Passing, Streams, passed_on


class Door(Passing):
    """Passes everything on to the gate before the store.

    Parameters
    ----------
    port
        Where it listens.
    gate
        Address and port number.
    certified
        What it encrypts with.
    """

    def __init__(self, port: Port, gate: tuple[str, int], certified: ssl.SSLContext) -> None:
        self.port = port
        self._gate = gate
        super().__init__(port, certified)

    async def answer(self, here: Streams) -> None:
        """Pass a connection on."""
        await passed_on(here, await asyncio.open_connection(*self._gate))
