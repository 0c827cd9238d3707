"""Clients that take their answers slowly, or not at all."""

import socket
import threading
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from typing import cast

import pytest
import uvicorn
from starlette.types import Receive, Scope, Send

from jointplay.service.access.concurrency import ConcurrencyLimit
from jointplay.service.pieces import BUDGET, Pieces
from jointplay.service.processes import connection_limit, connections
from jointplay.service.processes.connection_limit import ConnectionLimit
from jointplay.service.processes.connections import Connection, protocol
from tests.service_in_thread import Served, in_thread
from tests.waiting import until

SHORT, LONG = 30_000, 3_000_000
"""Bytes of answers; the system keeps more than a hundred of the former for a client at most."""


class Answering:
    """Answers with as many bytes as the path says, and counts."""

    def __init__(self) -> None:
        self.begun = self.running = 0

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        size = int(scope["path"][1:])
        self.begun += 1
        self.running += 1
        head = [(b"content-length", str(size).encode())]
        await send({"type": "http.response.start", "status": 200, "headers": head})
        await send({"type": "http.response.body", "body": b"x" * size})
        self.running -= 1


@pytest.fixture
def application() -> Answering:
    return Answering()


@pytest.fixture
def server(application: Answering) -> Iterator[Served]:
    limited = ConcurrencyLimit(Pieces(application), [], keys=False)
    configuration = uvicorn.Config(limited, http=protocol(), lifespan="off", log_config=None)
    with in_thread(configuration, force=True) as served:
        yield served


def asked(size: int, count: int = 1) -> bytes:
    return count * f"GET /{size} HTTP/1.1\r\nHost: a\r\n\r\n".encode()


def with_little_room(address: tuple[str, int], own: str = "127.0.0.1") -> socket.socket:
    one = socket.socket()
    one.bind((own, 0))
    one.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
    one.settimeout(60.0)
    one.connect(address)
    return one


def connections_of(server: uvicorn.Server) -> list[Connection]:
    return cast("list[Connection]", list(server.server_state.connections))


def is_full(server: uvicorn.Server) -> bool:
    return any(each.flow.write_paused for each in connections_of(server))


def test_requests_wait_until_the_answers_before_are_taken(
    server: Served,
    application: Answering,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(connections, "READER_PATIENCE", 3600.0)
    running, address = server
    with with_little_room(address) as one:
        one.sendall(asked(SHORT, 200))
        until(lambda: is_full(running) and application.running == 0)
        assert application.begun < 200
        taken = 0
        while taken < 200 * SHORT:
            taken += one.recv(65536).count(b"x")
        assert application.begun == 200


def test_a_connection_with_an_answer_that_is_not_taken_makes_room_at_once(
    server: Served, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(connections, "READER_PATIENCE", 3600.0)
    running, address = server
    with with_little_room(address) as one:
        one.sendall(asked(SHORT, 200))
        until(lambda: is_full(running))
        (held,) = connections_of(running)
        held.loop.call_soon_threadsafe(held.end)
        until(lambda: not connections_of(running))


def test_a_client_that_takes_its_answer_slowly_gets_it(
    server: Served, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(connections, "READER_PATIENCE", 4.0)
    with with_little_room(server[1]) as one:
        one.sendall(asked(LONG, 2))
        taken = 0
        while taken < LONG // 2:  # beside the answer itself the system would keep the other
            piece = one.recv(16_000)
            assert piece, f"closed after {taken} bytes"
            taken += len(piece)
            time.sleep(0.1)


def test_long_answers_that_nobody_takes_share_a_bound(
    server: Served,
    application: Answering,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(connections, "READER_PATIENCE", 3600.0)
    monkeypatch.setattr(BUDGET, "most", 2 * LONG)
    _, address = server

    def status() -> int:
        with with_little_room(address) as one:
            one.sendall(asked(LONG))
            return int(one.recv(1000).split()[1])

    with with_little_room(address) as first, with_little_room(address) as second:
        first.sendall(asked(LONG))
        second.sendall(asked(LONG))
        until(lambda: application.begun == 2)
        assert status() == 503
    until(lambda: status() == 200)


def test_one_address_cannot_have_all_connections(
    server: Served,
    application: Answering,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    running, address = server
    monkeypatch.setattr(running.config.http_protocol_class, "limit", ConnectionLimit(4))
    with ExitStack() as stack:
        for _ in range(3):
            stack.enter_context(with_little_room(address)).sendall(asked(LONG))
        until(lambda: application.begun == 3)
        refused = stack.enter_context(with_little_room(address))
        assert refused.recv(1000).startswith(b"HTTP/1.1 503")
        other = stack.enter_context(with_little_room(address, "127.0.0.2"))
        other.sendall(asked(SHORT))
        assert other.recv(1000).startswith(b"HTTP/1.1 200")


def test_those_of_the_address_that_has_most_make_room(
    server: Served, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(connections, "HEAD_PATIENCE", 3600.0)
    running, address = server
    monkeypatch.setattr(running.config.http_protocol_class, "limit", ConnectionLimit(4))
    with ExitStack() as stack:
        few = stack.enter_context(with_little_room(address, "127.0.0.2"))
        many = [stack.enter_context(with_little_room(address)) for _ in range(3)]
        until(lambda: len(connections_of(running)) == 4)
        new = stack.enter_context(with_little_room(address, "127.0.0.3"))
        assert many[0].recv(1) == b""
        for one in (few, new, *many[1:]):
            one.sendall(asked(1))
            assert one.recv(1000).startswith(b"HTTP/1.1 200")


def test_those_that_were_never_asked_make_room_first(
    server: tuple[uvicorn.Server, tuple[str, int]], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(connections, "HEAD_PATIENCE", 3600.0)
    running, address = server
    monkeypatch.setattr(running.config.http_protocol_class, "limit", ConnectionLimit(8))

    def answers(one: socket.socket) -> bool:
        one.sendall(asked(1))
        answer = one.recv(1000)
        while answer and not answer.endswith(b"\r\n\r\nx"):
            answer += one.recv(1000)
        return answer.startswith(b"HTTP/1.1 200")

    with ExitStack() as stack:
        used = [stack.enter_context(with_little_room(address)) for _ in range(2)]
        assert all(map(answers, used))
        for _ in range(20):
            new = stack.enter_context(with_little_room(address))
        assert answers(new)
        assert all(map(answers, used))
        for _ in range(20):  # they have no more than half of the room for themselves
            used.append(stack.enter_context(with_little_room(address)))
            assert answers(used[-1])
        new = [stack.enter_context(with_little_room(address)) for _ in range(2)]
        assert all(map(answers, new))


@contextmanager
def at_once(
    server: tuple[uvicorn.Server, tuple[str, int]], sent: Sequence[bytes]
) -> Iterator[list[socket.socket]]:
    """Open connections that have sent something by the time the server hears of the first one.

    One that was there before is given, too; it asks for something then.
    """
    running, address = server
    with with_little_room(address) as first, ExitStack() as stack:
        until(lambda: len(connections_of(running)) == 1)
        (held,) = connections_of(running)
        go = threading.Event()
        held.loop.call_soon_threadsafe(go.wait)
        first.sendall(asked(1))
        new = [stack.enter_context(with_little_room(address)) for _ in sent]
        for one, content in zip(new, sent, strict=True):
            one.sendall(content)
        go.set()
        yield [first, *new]


def test_of_many_that_come_at_once_none_is_closed_unheard(
    server: tuple[uvicorn.Server, tuple[str, int]], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(server[0].config.http_protocol_class, "limit", ConnectionLimit(8))
    with at_once(server, [asked(1)] * 9) as ones:
        answers = Counter(one.recv(1000)[9:12] for one in ones)
    assert answers == {b"200": 8, b"503": 2}  # six have room, and two wait in the queue


def test_who_comes_last_of_many_is_heard(
    server: tuple[uvicorn.Server, tuple[str, int]], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Those before have all sent something that nobody has read yet: halves of heads."""
    monkeypatch.setattr(server[0].config.http_protocol_class, "limit", ConnectionLimit(8))
    half = b"GET /1 HTTP/1.1\r\nHost: a\r\nX-Half: "
    with at_once(server, [half] * 40 + [asked(1)]) as (_, *halves, last):
        assert last.recv(1000)[9:12] == b"200"
        assert halves[0].recv(1000) == b""


def test_what_makes_room_is_found_behind_those_that_are_not_read_yet(
    server: tuple[uvicorn.Server, tuple[str, int]], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(server[0].config.http_protocol_class, "limit", ConnectionLimit(6))
    monkeypatch.setattr(connection_limit, "LOOKED_AT", 1)
    sent = [asked(1), asked(1), b"", asked(1), asked(1), asked(1)]
    with at_once(server, sent) as ones:
        answers = [one.recv(1000)[9:12] for one in ones]
    assert answers == [b"200", b"200", b"200", b"", b"503", b"200", b"200"]  # one waited
