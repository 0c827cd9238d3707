"""Encrypted connections: certificates of an authority that is known are taken, and no others."""

import asyncio
import multiprocessing
import os
import socket
import ssl
import subprocess
import sys
from collections.abc import Callable, Coroutine, Iterator
from contextlib import ExitStack, closing, contextmanager, suppress
from pathlib import Path

import httpx
import pytest
from kombu.exceptions import OperationalError
from redis.exceptions import RedisError
from trustme import CA

from jointplay.client import Client
from jointplay.service.processes.broker import Broker
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import Unavailable
from jointplay.worker.app import KEY_PREFIX, RUN_BLOCK, make_app
from jointplay.worker.joined.connection import Connection
from jointplay.worker.joined.protocol import ClaimRequest
from jointplay.worker.wake_up import connection
from tests.postgresql_server import running_server
from tests.waiting import until

HOST = "127.0.0.2"
"""Address of this machine, and none of the names to which our clients speak unencrypted."""
FILES = 256
"""Files that the API may have open."""
SWING = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 0.1}


@pytest.fixture(scope="module")
def authority() -> CA:
    return CA()


@pytest.fixture(scope="module")
def files(authority: CA, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the authority's certificate, that of a stranger, and ours with its key."""
    folder = tmp_path_factory.mktemp("certificates")
    authority.cert_pem.write_to_path(folder / "known.pem")
    CA().cert_pem.write_to_path(folder / "stranger.pem")
    own = authority.issue_cert(HOST)
    own.private_key_and_cert_chain_pem.write_to_path(folder / "own.pem")
    return folder


@pytest.fixture(scope="module")
def served(files: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """Address of an API over HTTPS that has no workers of its own."""
    with socket.create_server((HOST, 0)) as free:
        port = free.getsockname()[1]
    command = [sys.executable, "-P", "-m", "jointplay.service.processes.api", "--host", HOST]
    command += ["--port", str(port), "--ssl-certfile", str(files / "own.pem")]
    data = {"JOINTPLAY_DATA": str(tmp_path_factory.mktemp("data"))}
    few = ["sh", "-c", f'ulimit -n {FILES}; exec "$@"', "sh"]
    with subprocess.Popen(few + command, env=os.environ | data) as api:
        url = f"https://{HOST}:{port}"
        known = ssl.create_default_context(cafile=files / "known.pem")

        def answers() -> bool:
            assert api.poll() is None
            with suppress(httpx.TransportError):
                return httpx.get(f"{url}/healthz", verify=known).is_success
            return False

        until(answers)
        yield url
        api.terminate()


def test_a_worker_computes_for_a_service_that_it_can_verify(
    served: str, files: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    command = [sys.executable, "-P", "-m", "jointplay", "worker", "--join", served, "--idle", "1"]
    monkeypatch.setenv("SSL_CERT_FILE", str(files / "known.pem"))
    with Client(served) as client:
        job = client.submit(SWING)
        assert "computed 1 blocks" in subprocess.check_output(command, text=True)
        assert job.wait().state == "succeeded"
    with pytest.raises(httpx.RemoteProtocolError):
        httpx.get(f"{served}/healthz".replace("https", "http"), trust_env=False)
    monkeypatch.setenv("SSL_CERT_FILE", str(files / "stranger.pem"))
    request = ClaimRequest(program="0", worker="w", version="1", processor="p", wait=0.0)
    with (
        closing(Connection(served, None)) as worker,
        pytest.raises(Unavailable, match="CERTIFICATE_VERIFY_FAILED"),
    ):
        worker.claim(request)


def test_clients_that_never_agree_on_tls_keep_nobody_out(served: str, files: Path) -> None:
    known = ssl.create_default_context(cafile=files / "known.pem")
    address = httpx.URL(served)
    with ExitStack() as stack:
        for _ in range(FILES + 50):
            stack.enter_context(socket.create_connection((HOST, address.port), timeout=60.0))
        for _ in range(5):  # asyncio would wait a minute for them
            assert httpx.get(f"{served}/healthz", verify=known, timeout=20.0).is_success


Streams = tuple[asyncio.StreamReader, asyncio.StreamWriter]
_ASKS = b"\x00\x00\x00\x08\x04\xd2\x16\x2f"
"""The request for TLS that a client of PostgreSQL begins with."""


async def speak_tls(
    listening: socket.socket,
    connect: Callable[[], Coroutine[None, None, Streams]],
    certificate: Path,
    asks: bytes,
) -> None:
    context = ssl.create_default_context(ssl.Purpose.CLIENT_AUTH)
    context.load_cert_chain(certificate)

    async def copy(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        with suppress(OSError):
            while content := await reader.read(65536):
                writer.write(content)
                await writer.drain()
        writer.close()

    async def meet(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        if asks:
            assert await reader.readexactly(len(asks)) == asks
            writer.write(b"S")
        with suppress(OSError):  # a client that does not trust us
            await writer.start_tls(context)
            there = await connect()
            await asyncio.gather(copy(reader, there[1]), copy(there[0], writer))

    server = await asyncio.start_server(meet, sock=listening)
    await server.serve_forever()


@contextmanager
def encrypted(
    connect: Callable[[], Coroutine[None, None, Streams]], certificate: Path, asks: bytes = b""
) -> Iterator[int]:
    """Have a server speak TLS on a port, as one that has it would."""
    with socket.create_server((HOST, 0)) as listening:
        speaking = multiprocessing.get_context("fork").Process(
            target=lambda: asyncio.run(speak_tls(listening, connect, certificate, asks))
        )
        speaking.start()
        try:
            yield listening.getsockname()[1]
        finally:
            speaking.kill()
            speaking.join()


def test_wake_ups_go_through_a_redis_that_can_be_verified(files: Path, tmp_path: Path) -> None:
    broker = Broker(tmp_path / "broker", tmp_path / "broker.log")
    broker.start()
    try:
        path = broker.url.removeprefix("unix://")
        with encrypted(lambda: asyncio.open_unix_connection(path), files / "own.pem") as port:
            url = f"rediss://{HOST}:{port}/0?ssl_ca_certs={files}/"
            with make_app(f"{url}known.pem") as app, connection(f"{url}known.pem") as redis:
                app.send_task(RUN_BLOCK, args=["block"], queue="jobs")
                assert redis.llen(f"{KEY_PREFIX}jobs") == 1
            with make_app(f"{url}stranger.pem") as app, connection(f"{url}stranger.pem") as redis:
                with pytest.raises(RedisError, match="CERTIFICATE_VERIFY_FAILED"):
                    redis.ping()
                with (
                    app.connection_for_write() as own,  # not one that is kept for all
                    pytest.raises(OperationalError, match="CERTIFICATE_VERIFY_FAILED"),
                ):
                    own.ensure_connection(max_retries=1, interval_start=0.0)
    finally:
        broker.stop()


def test_a_catalogue_is_kept_by_a_postgresql_that_can_be_verified(files: Path) -> None:
    with running_server() as server:
        database = server.new().rpartition("/")[2]
        with encrypted(
            lambda: asyncio.open_connection("127.0.0.1", server.port), files / "own.pem", _ASKS
        ) as port:
            url = f"postgresql://postgres@{HOST}:{port}/{database}?sslmode=verify-full&sslrootcert="
            with closing(Catalogue(f"{url}{files / 'known.pem'}")) as catalogue:
                catalogue.ping()
            with closing(Catalogue(f"{url}{files / 'stranger.pem'}")) as catalogue:
                with pytest.raises(Unavailable):
                    catalogue.ping()
                (flaw,) = catalogue.flaws()
                assert "certificate verify failed" in flaw
