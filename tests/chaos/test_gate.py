"""A gate passes on what a server says, until it is shut."""

import socketserver
import threading
from collections.abc import Iterator
from pathlib import Path

import httpx
import pytest

from jointplay.chaos.gate import Gate
from jointplay.chaos.servers import NotEmpty, require_empty, store_behind_gate
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.object_stores import object_store_at


class Answers(socketserver.StreamRequestHandler):
    """Answers whatever is asked."""

    def handle(self) -> None:
        while self.rfile.readline().strip():
            pass
        self.wfile.write(b"HTTP/1.1 200 OK\r\nContent-Length: 100000\r\n\r\n" + b"x" * 100_000)


@pytest.fixture
def port() -> Iterator[int]:
    with socketserver.ThreadingTCPServer(("127.0.0.1", 0), Answers) as server:
        threading.Thread(target=server.serve_forever).start()
        yield server.server_address[1]
        server.shutdown()


def test_a_gate_passes_on_until_it_is_shut_and_when_it_is_open_again(port: int) -> None:
    gate = Gate("127.0.0.1", port)
    url = f"http://127.0.0.1:{gate.port}"
    for _ in range(2):
        assert httpx.get(url, trust_env=False).content == b"x" * 100_000
        gate.shut()
        with pytest.raises(httpx.TransportError):
            httpx.get(url, trust_env=False)
        gate.open()


def test_only_a_store_without_encryption_has_a_gate(port: int) -> None:
    address, gate = store_behind_gate(f"s3://b/p?endpoint=http://127.0.0.1:{port}&region=r")
    assert gate is not None
    assert address == f"s3://b/p?endpoint=http%3A%2F%2F127.0.0.1%3A{gate.port}&region=r"
    for encrypted in ("s3://b/p?endpoint=https://host", "s3://b/p", ""):
        assert store_behind_gate(encrypted) == (encrypted, None)


def test_what_is_somebodys_is_refused(tmp_path: Path) -> None:
    url, address = f"sqlite:///{tmp_path / 'somebodys.sqlite'}", f"file:{tmp_path / 'somebodys'}"
    require_empty("", address)
    catalogue = Catalogue(url)
    catalogue.migrate()
    catalogue.close()
    object_store_at(address).put("2R/notes", [b"mine"])
    with pytest.raises(NotEmpty, match="has tables"):
        require_empty(url, "")
    with pytest.raises(NotEmpty, match="has objects"):
        require_empty("", address)
