"""A gate before the S3 server: it passes everything on, or answers everything with 503."""

import asyncio
import re
import socket
import threading
from contextlib import suppress

from tests.machines.network import Port

_LENGTH = re.compile(rb"\r\ncontent-length: *(\d+)", re.IGNORECASE)
_REFUSAL = b"HTTP/1.1 503 Slow Down\r\nContent-Length: 0\r\nConnection: close\r\n\r\n"


class Gate:
    """Listens at an address of a port, in a thread of its own.

    Parameters
    ----------
    port
        Where it listens.
    server
        Port number of the server there.
    """

    def __init__(self, port: Port, server: int) -> None:
        self._port, self._server = port, server
        self._passing: set[asyncio.Task[None]] = set()
        self._refuses = False
        with port.inside():
            self._listening = socket.create_server((port.address, 0), backlog=256)
        self.url = f"http://{port.address}:{self._listening.getsockname()[1]}"
        self._loop = asyncio.new_event_loop()
        threading.Thread(target=self._run, name="gate", daemon=True).start()

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

    def _run(self) -> None:
        with self._port.inside():  # for good: connections to the server begin there
            self._loop.run_until_complete(self._serve())

    async def _serve(self) -> None:
        server = await asyncio.start_server(self._answer, sock=self._listening)
        await server.serve_forever()

    async def _answer(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        task = asyncio.current_task()
        assert task is not None
        try:
            if self._refuses:
                await _refuse(reader, writer)
            else:
                self._passing.add(task)
                await self._pass(reader, writer)
        except (OSError, asyncio.IncompleteReadError, asyncio.CancelledError):
            writer.transport.abort()
        finally:
            self._passing.discard(task)
            writer.close()

    async def _pass(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        there = await asyncio.open_connection(self._port.address, self._server)
        try:
            async with asyncio.TaskGroup() as both:
                both.create_task(_pump(reader, there[1]))
                both.create_task(_pump(there[0], writer))
        except* OSError:
            pass
        finally:
            there[1].close()


async def _pump(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
    while piece := await reader.read(2**16):
        writer.write(piece)
        await writer.drain()
    with suppress(OSError):
        writer.write_eof()


async def _refuse(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
    head = await reader.readuntil(b"\r\n\r\n")
    if found := _LENGTH.search(head):
        await reader.readexactly(int(found[1]))
    writer.write(_REFUSAL)
    await writer.drain()
