"""Connections of clients, bounded: none is held for nothing, and one address cannot have all.

uvicorn counts connections, and refuses all requests while there are too many, whoever has them.
Here a connection that waits for a request makes room for a new one: one of the address that has
most, and of those that were never asked anything, unless more of the others wait. One that has sent
no whole head in `HEAD_PATIENCE` is closed, and one whose client takes nothing of its answer in
`READER_PATIENCE`. A request waits until the answers before it are taken: it has no turn meanwhile.
"""

import asyncio
import logging
import resource
import socket
import struct
from fcntl import ioctl
from http import HTTPStatus
from termios import FIONREAD
from typing import Any

import h11
from uvicorn.protocols.http.h11_impl import H11Protocol, RequestResponseCycle

from jointplay.service.content_policy import DEFAULTS
from jointplay.service.problems import MEDIA_TYPE, ProblemDocument
from jointplay.service.problems.kinds import NO_REQUEST, UNAVAILABLE, ProblemKind
from jointplay.service.processes.connection_limit import MOST, ConnectionLimit

HEAD_PATIENCE = 5.0  # s
READER_PATIENCE = 30.0  # s
UNSENT = 64 * 1024
"""Bytes of an answer that the system keeps beyond those on their way: it would keep megabytes, and
say for as long as a slow client takes a third of them that it takes nothing."""
RETRY = 5  # s, what a refused client is told

Timer = asyncio.TimerHandle | None

_log = logging.getLogger(__name__)


class Connection(H11Protocol):
    """One connection, which is closed where it keeps others out."""

    limit: ConnectionLimit

    def __init__(self, *arguments: Any, **named: Any) -> None:
        super().__init__(*arguments, **named)
        self.address = ""
        self._head: Timer = None
        self._reader: Timer = None

    @property
    def asked(self) -> bool:
        """See `LimitedConnection`."""
        return self.cycle is not None

    @property
    def unread(self) -> bool:
        """See `LimitedConnection`."""
        return has_unread(self.transport)

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Let the connection in, or let it wait in the queue."""
        super().connection_made(transport)
        transport.get_extra_info("socket").setsockopt(
            socket.IPPROTO_TCP, socket.TCP_NOTSENT_LOWAT, UNSENT
        )
        self.address = address_of(transport)
        self.flow.pause_reading()
        self.limit.admit(self)

    def connection_lost(self, exc: Exception | None) -> None:
        """Give its room to others."""
        super().connection_lost(exc)
        self.limit.leave(self)
        self._head, self._reader = _cancel(self._head), _cancel(self._reader)

    def data_received(self, data: bytes) -> None:
        """Take what was sent: a head must become whole soon."""
        if self not in self.limit:
            return
        super().data_received(data)
        self._look()

    def handle_events(self) -> None:
        """Begin what was asked, once the client has taken what it asked for before."""
        if self.flow.write_paused:
            self.flow.pause_reading()
            return
        super().handle_events()

    def on_response_complete(self) -> None:
        """Wait for the next request, and until all of the answer is taken."""
        self.transport.set_write_buffer_limits(high=1, low=0)  # pauses now if there is anything
        super().on_response_complete()
        self._look()

    def pause_writing(self) -> None:
        """Wait for a client that does not take its answer, but not for ever."""
        super().pause_writing()
        if self._reader is None:
            self._reader = self.loop.call_later(READER_PATIENCE, self._cut_off)

    def resume_writing(self) -> None:
        """Go on: the client took some."""
        super().resume_writing()
        self._reader = _cancel(self._reader)
        if self.transport.is_closing():
            return
        if self.cycle.response_complete:
            self.flow.resume_reading()
        self.handle_events()
        self._look()

    def send_400_response(self, msg: str) -> None:
        """Tell a client that it sent no request, unless its answer has begun."""
        if self.conn.our_state in (h11.IDLE, h11.SEND_RESPONSE):
            self.transport.write(NOT_HTTP)
        self.transport.close()

    def end(self) -> None:
        """Close a connection that waits for a request."""
        self.limit.leave(self)
        if self.flow.write_paused:
            self._cut_off()
        else:  # nothing is unsent; to end TLS in order would take what the client likes
            self.transport.abort()

    def begin(self) -> None:
        """See `LimitedConnection`."""
        self.flow.resume_reading()
        self._await_head()

    def refuse(self) -> None:
        """See `LimitedConnection`."""
        _log.debug("no room for a connection of %s", self.address)
        self.transport.write(REFUSAL)
        self.transport.close()

    def _look(self) -> None:
        """Tell a connection with a request from one that waits for its head, or for any."""
        if self not in self.limit:
            return
        cycle: RequestResponseCycle | None = self.cycle
        if cycle is not None and not cycle.response_complete:
            self._head = _cancel(self._head)
            self.limit.work(self)
            self.transport.set_write_buffer_limits()
            return
        self.limit.rest(self)
        if self.conn.trailing_data[0]:
            self._await_head()

    def _await_head(self) -> None:
        if self._head is None:
            self._head = self.loop.call_later(HEAD_PATIENCE, self._close_headless)

    def _cut_off(self) -> None:
        """End at once; else the system would keep what was not taken, for minutes."""
        self.transport.get_extra_info("socket").setsockopt(
            socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0)
        )
        self.transport.abort()

    def _close_headless(self) -> None:
        self._head = None
        self.transport.close()


def protocol() -> type[Connection]:
    """Return the class of connections of one server, with a limit of its own."""
    files, _ = resource.getrlimit(resource.RLIMIT_NOFILE)
    return type(
        "ConnectionOfThisProcess", (Connection,), {"limit": ConnectionLimit(min(MOST, files // 2))}
    )


def address_of(transport: asyncio.Transport) -> str:
    """Return the address of a client, without its port; empty if it is gone."""
    peer = transport.get_extra_info("peername")
    return str(peer[0]) if isinstance(peer, tuple) else ""


def has_unread(transport: asyncio.Transport) -> bool:
    """Return whether the system keeps bytes of a client that nobody has read."""
    number = transport.get_extra_info("socket").fileno()
    return any(ioctl(number, FIONREAD, bytes(4)))


def _cancel(timer: Timer) -> Timer:
    if timer is not None:
        timer.cancel()
    return None


def _refusal(kind: ProblemKind, detail: str, **headers: str) -> bytes:
    """Return an answer of which no application knows."""
    document = ProblemDocument(type=kind.type, title=kind.title, status=kind.status, detail=detail)
    body = document.model_dump_json(exclude_defaults=True).encode()
    fields = {"Content-Type": MEDIA_TYPE, **DEFAULTS, **headers}
    fields |= {"Connection": "close", "Content-Length": str(len(body))}
    head = f"HTTP/1.1 {kind.status} {HTTPStatus(kind.status).phrase}\r\n"
    head += "".join(f"{name}: {value}\r\n" for name, value in fields.items())
    return f"{head}\r\n".encode() + body


REFUSAL = _refusal(
    UNAVAILABLE,
    "There are too many connections; close those that are idle, and ask again.",
    **{"Retry-After": str(RETRY)},
)
NOT_HTTP = _refusal(NO_REQUEST, "What was sent is no HTTP/1.1 request, or its head is too long.")
