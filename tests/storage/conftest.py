"""Real servers for all specifications of storage: each is started once, when a test asks for it."""

import itertools
from collections.abc import Callable, Iterator

import pytest

from tests.postgresql_server import Server, running_server
from tests.seaweedfs_server import BUCKET, running_store


@pytest.fixture(scope="session")
def postgresql() -> Iterator[Server]:
    with running_server() as server:
        yield server


@pytest.fixture(scope="session")
def endpoint() -> Iterator[str]:
    with running_store() as endpoint:
        yield endpoint


@pytest.fixture(scope="session")
def new_address(endpoint: str) -> Callable[[], str]:
    number = itertools.count()
    return lambda: f"s3://{BUCKET}/store{next(number)}?endpoint={endpoint}"
