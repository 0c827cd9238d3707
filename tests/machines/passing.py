"""Connections that are passed on to a server, both ways, until one side ends."""

import asyncio
import re
import socket
import ssl
import threading
from abc import ABC, abstractmethod
from contextlib import suppress

from trustme import CA

from tests.machines.network import Port

_LENGTH = re.compile(rb"\r\ncontent-length: *(\d+)", re.IGNORECASE)
Streams = tuple[asyncio.StreamReader, asyncio.StreamWriter]


class Passing(ABC):
    """Listens at an address of a port, in a thread of its own that is there for good.

    Parameters
    ----------
    port
        Where it listens, and where connections to servers begin.
    encrypted
        Certificate and key of what it listens for; none: nothing is encrypted.
    """

    def __init__(self, port: Port, encrypted: ssl.SSLContext | None = None) -> None:
        self._port, self._encrypted = port, encrypted
        self._answering: set[asyncio.Task[None] | None] = set()
        with port.inside():
            self._listening = socket.create_server((port.address, 0), backlog=256)
        scheme = "http" if encrypted is None else "https"
        self.url = f"{scheme}://{port.address}:{self._listening.getsockname()[1]}"
        self._loop = asyncio.new_event_loop()
        threading.Thread(target=self._run, name="passing", daemon=True).start()

    @abstractmethod
    async def answer(self, here: Streams) -> None:
        """Do with a new connection what is to be done; it is closed afterwards."""

    def _run(self) -> None:
        with self._port.inside():
            self._loop.run_until_complete(self._serve())

    async def _serve(self) -> None:
        server = await asyncio.start_server(self._answer, sock=self._listening, ssl=self._encrypted)
        await server.serve_forever()

    async def _answer(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        task = asyncio.current_task()
        self._answering.add(task)  # asyncio lets go of it when the connection ends, and it waits on
        try:
            await self.answer((reader, writer))
        except (OSError, asyncio.IncompleteReadError, asyncio.CancelledError):
            writer.transport.abort()
        finally:
            self._answering.discard(task)
            writer.close()


def certified(authority: CA, port: Port) -> ssl.SSLContext:
    """Return what a server at a port encrypts with, as an authority says."""
    encrypted = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
    authority.issue_cert(port.address).configure_cert(encrypted)
    return encrypted


async def passed_on(here: Streams, there: Streams) -> None:
    """Return when neither side has anything to say."""
    try:
        async with asyncio.TaskGroup() as both:
            both.create_task(_pump(here[0], there[1]))
            both.create_task(_pump(there[0], here[1]))
    except* OSError:
        pass
    finally:
        there[1].close()


async def _pump(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
    while piece := await reader.read(2**16):
        writer.write(piece)
        await writer.drain()
    with suppress(OSError):
        if writer.can_write_eof():
            writer.write_eof()
        else:  # what is encrypted ends both ways
            writer.close()


async def refused(here: Streams, answer: bytes) -> None:
    """Answer the next request when it was read whole: else the end comes before the answer."""
    reader, writer = here
    head = await reader.readuntil(b"\r\n\r\n")
    if found := _LENGTH.search(head):
        await reader.readexactly(int(found[1]))
    writer.write(answer)
    await writer.drain()
