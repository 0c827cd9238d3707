"""Connections of HTTPS, bounded from their first moment on: while TLS is agreed on, too.

asyncio would have a server hear of a connection only afterwards, and wait for it for a minute.
"""

import asyncio
import ssl
from contextlib import suppress
from typing import Any

import uvicorn

from jointplay.service.processes import connections
from jointplay.service.processes.connections import Connection, address_of, has_unread


class EncryptedConfig(uvicorn.Config):
    """Settings of a server whose connections agree on TLS by themselves, as the settings say."""

    def load(self) -> None:
        """Load the settings."""
        super().load()
        parts = {"made": self.http_protocol_class, "context": self.ssl}
        self.http_protocol_class = type("HandshakeOfThisProcess", (Handshake,), parts)
        self.ssl = None


class Handshake(asyncio.Protocol):
    """A connection until TLS is agreed on: it has room as an idle one."""

    made: type[Connection]
    """Class of what it is afterwards."""
    context: ssl.SSLContext
    asked = False

    def __init__(self, **named: Any) -> None:
        self._connection = self.made(**named)
        self._limit = self.made.limit
        self._sent = bytearray()
        self._agreeing: asyncio.Task[None] | None = None

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Let the connection in, or let it wait in the queue."""
        self._transport, self.address = transport, address_of(transport)
        transport.pause_reading()
        self._limit.admit(self)

    def data_received(self, data: bytes) -> None:
        """Keep what came with the end of the handshake."""
        self._sent += data

    @property
    def unread(self) -> bool:
        """Whether the client goes on with the handshake."""
        return has_unread(self._transport)

    def begin(self) -> None:
        """Agree on TLS."""
        self._transport.resume_reading()
        self._agreeing = asyncio.create_task(self._agree())

    def refuse(self) -> None:
        """Close the connection: nothing can be told to it yet."""
        self._transport.abort()

    def end(self) -> None:
        """Make room for others."""
        self._limit.leave(self)
        self._transport.abort()

    def connection_lost(self, exc: Exception | None) -> None:
        """Make room for others: the client has gone."""
        self._limit.leave(self)

    async def _agree(self) -> None:
        encrypted: asyncio.Transport | None = None
        with suppress(OSError):  # the client is silent, speaks no TLS, or has gone
            encrypted = await asyncio.get_running_loop().start_tls(
                self._transport,
                self,
                self.context,
                server_side=True,
                ssl_handshake_timeout=connections.HEAD_PATIENCE,
                ssl_shutdown_timeout=connections.HEAD_PATIENCE,
            )
        self._limit.leave(self)
        if encrypted is None or encrypted.is_closing():
            return
        encrypted.set_protocol(self._connection)
        self._connection.connection_made(encrypted)
        if self._sent:
            self._connection.data_received(bytes(self._sent))
