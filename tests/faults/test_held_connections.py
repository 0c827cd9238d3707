"""Connections that are held for nothing keep nobody out."""

import select
import socket
import time
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path

import httpx
import pytest

from jointplay.service.processes import connections, running_service

HELD = 1000
HALF = b"GET /healthz HTTP/1.1\r\nHost: 127.0.0.1\r\nX-Half: "


@pytest.fixture(scope="module")
def address(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[str, int]]:
    folder: Path = tmp_path_factory.mktemp("held")
    with running_service(folder / "data", workers=0) as url:
        found = httpx.URL(str(url))
        yield found.host, found.port or 80


def held(
    stack: ExitStack, address: tuple[str, int], count: int, sent: bytes = b""
) -> list[socket.socket]:
    found = []
    for _ in range(count):
        one = stack.enter_context(socket.create_connection(address, timeout=60.0))
        if sent:
            one.sendall(sent)
        found.append(one)
    return found


def healthy(address: tuple[str, int]) -> None:
    host, port = address
    for _ in range(5):
        assert httpx.get(f"http://{host}:{port}/healthz", timeout=60.0).status_code == 200


def ready(sockets: list[socket.socket]) -> list[socket.socket]:
    """Return those that an answer has come to; wait for the first a minute at most."""
    return select.select(sockets, [], [], 60.0)[0]


def closed(one: socket.socket) -> bool:
    """Return whether the service has closed a connection; wait for it a minute at most."""
    try:
        return one.recv(1) == b""
    except ConnectionError:
        return True


def test_idle_connections_make_room_for_others(address: tuple[str, int]) -> None:
    with ExitStack() as stack:
        held(stack, address, HELD)
        healthy(address)


def test_a_head_that_never_ends_is_closed(address: tuple[str, int]) -> None:
    with ExitStack() as stack:
        first, *_ = held(stack, address, 50, HALF)
        healthy(address)
        begun = time.monotonic()
        assert closed(first)
        assert time.monotonic() - begun >= 0.5 * connections.HEAD_PATIENCE


def test_a_kept_connection_whose_next_head_never_ends_is_closed(address: tuple[str, int]) -> None:
    with socket.create_connection(address, timeout=60.0) as one:
        one.sendall(b"GET /healthz HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n")
        answer = b""
        while not answer.endswith(b'{"status":"ok"}'):
            answer += one.recv(65536)
        assert answer.startswith(b"HTTP/1.1 200")
        one.sendall(HALF)
        assert closed(one)


def test_a_client_that_takes_nothing_of_its_answer_is_closed(address: tuple[str, int]) -> None:
    wanted = b"GET /openapi.json HTTP/1.1\r\nHost: 127.0.0.1\r\nAccept-Encoding: identity\r\n\r\n"
    with ExitStack() as stack:
        slow = []
        for _ in range(20):
            one = stack.enter_context(socket.socket())
            one.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
            one.settimeout(120.0)
            one.connect(address)
            one.sendall(10 * wanted)
            slow.append(one)
        healthy(address)


def test_bodies_that_never_end_take_no_memory_and_end(address: tuple[str, int]) -> None:
    head = b"POST /v1/batches HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Type: application/json\r\n"
    head += b"Content-Length: %d\r\n\r\n"
    with ExitStack() as stack:
        short = held(stack, address, 100, head % 1000 + b"[")
        large = held(stack, address, 20, head % 33_000_000 + b"[" + b" " * 8_000_000)
        healthy(address)
        answer = b""
        while not answer.endswith(b"}"):
            answer += short[0].recv(65536)
        assert answer.startswith(b"HTTP/1.1 408")
        assert b"body-too-slow" in answer
        assert sum(b" 503 " in one.recv(65536)[:20] for one in ready(large)) >= 4  # 160 MB for 128
