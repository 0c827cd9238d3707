"""The real service in a thread."""

import socket
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import httpx
import pytest
import uvicorn
from fastapi import FastAPI

from jointplay.service.app import create_app
from jointplay.service.processes.api import LONGEST_HEAD
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.settings import Settings
from tests.waiting import PATIENCE

Served = tuple[uvicorn.Server, tuple[str, int]]
"""A server that runs, and where it listens."""


@contextmanager
def in_thread(
    configuration: uvicorn.Config, port: int = 0, *, force: bool = False
) -> Iterator[Served]:
    """Run uvicorn in a thread; the socket listens before, so nobody has to wait.

    Parameters
    ----------
    force
        At the end connections that are busy are closed, not waited for.
    """
    # the protocol is named, else asyncio leaves Nagle's algorithm on: 40 ms a request
    listener = socket.socket(socket.AF_INET, socket.SOCK_STREAM, socket.IPPROTO_TCP)
    listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    listener.bind(("127.0.0.1", port))
    listener.listen()
    configuration.load()  # who is given the server may look at it
    server = uvicorn.Server(configuration)
    thread = threading.Thread(target=server.run, kwargs={"sockets": [listener]})
    thread.start()
    try:
        yield server, listener.getsockname()
    finally:
        server.force_exit = force
        server.should_exit = True
        thread.join()
        listener.close()


@contextmanager
def serving(app: FastAPI, port: int = 0) -> Iterator[str]:
    """Serve ``app`` in a thread, at the address that is returned."""
    configuration = uvicorn.Config(
        app, log_level="warning", lifespan="on", h11_max_incomplete_event_size=LONGEST_HEAD
    )
    with in_thread(configuration, port) as (_, (host, chosen)):
        yield f"http://{host}:{chosen}"


@pytest.fixture(scope="session")
def settings(tmp_path_factory: pytest.TempPathFactory) -> Settings:
    return Settings(data=tmp_path_factory.mktemp("data"))


@pytest.fixture(scope="session")
def application(settings: Settings) -> FastAPI:
    """The real application: SQLite and results in a temporary folder, no worker."""
    return create_app(settings)


@pytest.fixture(scope="session")
def service_url(application: FastAPI) -> Iterator[str]:
    with serving(application) as url:
        yield url


def client_of(url: str) -> httpx.Client:
    """Return a client that waits as long as a busy machine needs."""
    return httpx.Client(base_url=url, trust_env=False, timeout=PATIENCE)


@pytest.fixture(scope="session")
def http(service_url: str) -> Iterator[httpx.Client]:
    with client_of(service_url) as client:
        yield client


@pytest.fixture
def fresh_service(tmp_path: Path) -> Iterator[str]:
    """A service of its own, without jobs."""
    with serving(create_app(Settings(data=tmp_path / "data"))) as url:
        yield url


@pytest.fixture(scope="session")
def catalogue(settings: Settings, service_url: str) -> Iterator[Catalogue]:
    """The catalogue of the running service, as a worker sees it."""
    catalogue = Catalogue(settings.catalogue_url)
    yield catalogue
    catalogue.close()
