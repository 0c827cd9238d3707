"""Clients that never agree on TLS, or no longer answer once they have."""

import socket
import ssl
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path

import pytest
from starlette.responses import Response
from trustme import CA

from jointplay.service.processes import connections
from jointplay.service.processes.connection_limit import ConnectionLimit
from jointplay.service.processes.connections import protocol
from jointplay.service.processes.handshakes import EncryptedConfig
from tests.service_in_thread import Served, in_thread
from tests.waiting import until

ASKED = b"GET / HTTP/1.1\r\nHost: a\r\n\r\n"


@pytest.fixture(scope="module")
def authority() -> CA:
    return CA()


@pytest.fixture
def trusting(authority: CA) -> ssl.SSLContext:
    context = ssl.create_default_context()
    authority.configure_trust(context)
    return context


@pytest.fixture
def served(authority: CA, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Served]:
    """Return a server that has room for four connections, three of one address."""
    monkeypatch.setattr(connections, "HEAD_PATIENCE", 3600.0)
    authority.issue_cert("localhost").private_key_and_cert_chain_pem.write_to_path(
        tmp_path / "own.pem"
    )
    limited = protocol()
    monkeypatch.setattr(limited, "limit", ConnectionLimit(4))
    configuration = EncryptedConfig(
        Response("there"),
        http=limited,
        lifespan="off",
        log_config=None,
        ssl_certfile=tmp_path / "own.pem",
    )
    with in_thread(configuration, force=True) as served:
        yield served


def silent(address: tuple[str, int], own: str = "127.0.0.1") -> socket.socket:
    return socket.create_connection(address, timeout=60.0, source_address=(own, 0))


def closed(one: socket.socket) -> bool:
    try:
        return one.recv(1) == b""
    except ConnectionError:
        return True


def answered(one: socket.socket, trusting: ssl.SSLContext) -> bool:
    with trusting.wrap_socket(one, server_hostname="localhost") as agreed:
        agreed.sendall(ASKED)
        return agreed.recv(1000).startswith(b"HTTP/1.1 200")


def test_clients_that_never_agree_make_room_for_those_that_do(
    served: Served, trusting: ssl.SSLContext
) -> None:
    _, address = served
    with ExitStack() as stack:
        other = stack.enter_context(silent(address, "127.0.0.2"))
        held = [stack.enter_context(silent(address)) for _ in range(5)]
        assert closed(held[0])
        assert closed(held[1])
        assert answered(silent(address), trusting)
        stack.enter_context(silent(address))
        assert closed(held[2])
        assert answered(other, trusting)  # it kept its place


def test_who_does_not_agree_in_time_is_closed(
    served: Served, monkeypatch: pytest.MonkeyPatch
) -> None:
    server, address = served
    monkeypatch.setattr(connections, "HEAD_PATIENCE", 0.2)
    limit = server.config.http_protocol_class.made.limit  # type: ignore[union-attr]
    with silent(address) as one:
        assert closed(one)
    until(lambda: limit.held == 0)


def test_who_answers_no_more_is_closed_at_once_where_others_want_his_place(
    served: Served, trusting: ssl.SSLContext
) -> None:
    server, address = served
    with ExitStack() as stack:
        for _ in range(9):
            one = stack.enter_context(silent(address))
            one = stack.enter_context(trusting.wrap_socket(one, server_hostname="localhost"))
        one.sendall(ASKED)
        assert one.recv(1000).startswith(b"HTTP/1.1 200")
        until(lambda: len(server.server_state.connections) == 3)


def test_a_request_right_behind_the_handshake_is_answered(
    served: Served, trusting: ssl.SSLContext
) -> None:
    """The end of the handshake and the request arrive in one piece."""
    _, address = served
    incoming, outgoing = ssl.MemoryBIO(), ssl.MemoryBIO()
    client = trusting.wrap_bio(incoming, outgoing, server_hostname="localhost")
    with silent(address) as one:
        while True:
            try:
                client.do_handshake()
                break
            except ssl.SSLWantReadError:
                one.sendall(outgoing.read())
                incoming.write(one.recv(65536))
        client.write(ASKED)
        one.sendall(outgoing.read())
        found = b""
        while b"there" not in found:
            try:
                found += client.read(65536)
            except ssl.SSLWantReadError:
                incoming.write(one.recv(65536))
