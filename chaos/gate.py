"""A gate before a server: it passes everything on, or breaks every connection off."""

import asyncio
import socket
import threading
from contextlib import suppress

_PIECE = 2**16  # bytes


class Gate:
    """Listens on this machine, in a thread of its own that ends with the process.

    Parameters
    ----------
    host, port
        Where the server is.
    """

    def __init__(self, host: str, port: int) -> None:
        self._server = host, port
        self._shut = False
        self._passing: set[asyncio.StreamWriter] = set()
        self._listening = socket.create_server(("127.0.0.1", 0), backlog=256)
        self.port: int = self._listening.getsockname()[1]
        self._loop = asyncio.new_event_loop()
        threading.Thread(target=self._run, name="gate", daemon=True).start()

    def shut(self) -> None:
        """Break all connections off, and every new one from now on."""
        self._shut = True
        self._loop.call_soon_threadsafe(self._break_off)

    def open(self) -> None:
        """Pass everything on again."""
        self._shut = False

    def _break_off(self) -> None:
        for one in self._passing:
            one.transport.abort()

    def _run(self) -> None:
        self._loop.run_until_complete(self._serve())

    async def _serve(self) -> None:
        server = await asyncio.start_server(self._pass, sock=self._listening)
        await server.serve_forever()

    async def _pass(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        both = {writer}
        try:
            if not self._shut:
                there, back = await asyncio.open_connection(*self._server)
                both.add(back)
                self._passing |= both
                await asyncio.gather(_pump(reader, back), _pump(there, writer))
        except OSError:
            pass
        finally:
            self._passing -= both
            for one in both:
                one.transport.abort()


async def _pump(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
    while piece := await reader.read(_PIECE):
        writer.write(piece)
        await writer.drain()
    with suppress(OSError):
        writer.write_eof()
