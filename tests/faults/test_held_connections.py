"""Connections that are held for nothing keep nobody out."""

import json
import select
import socket
import time
from collections.abc import Iterator
from contextlib import ExitStack, closing
from pathlib import Path

import httpx
import pytest

from jointplay.service.processes import connections, running_service
from jointplay.storage.catalogue.catalogue import Catalogue
from tests.backends import BACKENDS, backends, settings_at
from tests.waiting import until

HELD = 1000
WANTED = b"GET /openapi.json HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n"
HALF = b"GET /healthz HTTP/1.1\r\nHost: 127.0.0.1\r\nX-Half: "


@pytest.fixture(scope="module", params=BACKENDS)
def keyed(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[tuple[tuple[str, int], str]]:
    """Return the address of a service that requires keys, and the header of an owner's key."""
    data: Path = tmp_path_factory.mktemp("held") / "data"
    data.mkdir()
    with backends(request.param) as variables:
        with closing(Catalogue(settings_at(data, variables).catalogue_url)) as catalogue:
            catalogue.migrate()
            key, _ = catalogue.make_key("ada", ["jobs:write"], "", None)
        with running_service(data, 0, variables | {"JOINTPLAY_KEYS": "required"}) as url:
            found = httpx.URL(str(url))
            yield (found.host, found.port or 80), f"Bearer {key}"


@pytest.fixture(scope="module")
def address(keyed: tuple[tuple[str, int], str]) -> tuple[str, int]:
    return keyed[0]


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
        begun = time.monotonic()  # before it is opened: the others may take seconds
        first, *_ = held(stack, address, 50, HALF)
        healthy(address)
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


@pytest.mark.long
def test_a_client_that_takes_nothing_of_its_answer_is_cut_off(address: tuple[str, int]) -> None:
    with socket.socket() as one:
        one.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        one.connect(address)
        begun = time.monotonic()
        one.sendall(400 * WANTED)  # more than the system keeps for it
        until(lambda: one.getsockopt(socket.SOL_SOCKET, socket.SO_ERROR) != 0)
        assert time.monotonic() - begun >= 0.5 * connections.READER_PATIENCE


BATCH = (
    "POST /v1/batches HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Type: application/json\r\n"
    "Authorization: {key}\r\nContent-Length: {length}\r\n\r\n["
)


def test_bodies_that_never_end_take_no_memory_and_end(keyed: tuple[tuple[str, int], str]) -> None:
    address, key = keyed
    small = BATCH.format(key=key, length=1000).encode()
    big = BATCH.format(key=key, length=33_000_000).encode() + b" " * 8_000_000
    with ExitStack() as stack:
        short = held(stack, address, 100, small)
        large = held(stack, address, 20, big)
        healthy(address)
        answer = b""
        while not answer.endswith(b"}"):
            answer += short[0].recv(65536)
        assert answer.startswith(b"HTTP/1.1 408")
        assert b"body-too-slow" in answer
        assert sum(b" 503 " in one.recv(65536)[:20] for one in ready(large)) >= 4  # 160 MB for 128


def test_callers_without_a_key_keep_out_nobody_who_has_one(
    keyed: tuple[tuple[str, int], str],
) -> None:
    """Idle connections, half heads, readers that take nothing and unfinished bodies at once."""
    address, key = keyed
    with ExitStack() as stack:
        held(stack, address, 1000)
        held(stack, address, 500, HALF)
        for _ in range(200):
            one = stack.enter_context(socket.socket())
            one.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
            one.connect(address)
            one.sendall(20 * WANTED)
        held(stack, address, 100, BATCH.format(key="Bearer none", length=33_000_000).encode())
        healthy(address)
        host, port = address
        with httpx.Client(headers={"Authorization": key}, timeout=60.0) as client:
            for number in range(20):
                job = {"kind": "simulate", "scene": {"preset": "pendulum"}}
                sent = client.post(
                    f"http://{host}:{port}/v1/jobs", json=job | {"duration": number + 1}
                )
                assert sent.status_code == 202


def test_a_key_counts_only_where_it_is_looked_at(keyed: tuple[tuple[str, int], str]) -> None:
    """Who takes nothing of an answer that needs no key holds no turn of keys with a wrong one."""
    (host, port), key = keyed
    wrong = WANTED.replace(b"\r\n\r\n", b"\r\nAuthorization: Bearer none\r\n\r\n")
    with ExitStack() as stack:
        for _ in range(260):
            one = stack.enter_context(socket.socket())
            one.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
            one.connect((host, port))
            one.sendall(20 * wrong)
        until(
            lambda: httpx.get(f"http://{host}:{port}/openapi.json", timeout=60).status_code == 503
        )
        jobs = httpx.get(
            f"http://{host}:{port}/v1/jobs", headers={"Authorization": key}, timeout=60
        )
        assert jobs.status_code == 403  # the key is for sending


def test_what_is_no_request_is_answered_with_a_problem(address: tuple[str, int]) -> None:
    with socket.create_connection(address, timeout=60.0) as one:
        one.sendall(b"GET / HTTP/1.1\r\nno header\r\n\r\n")
        answer = b"".join(iter(lambda: one.recv(65536), b"")).decode()
    head, _, body = answer.partition("\r\n\r\n")
    assert head.startswith("HTTP/1.1 400 Bad Request")
    assert "X-Content-Type-Options: nosniff" in head
    assert json.loads(body)["type"] == "/problems/no-request"
