import asyncio

import pytest

from jointplay.client import AsyncClient, Client
from tests.client.driven import Driven
from tests.service_in_thread import (
    application,
    catalogue,
    fresh_service,
    http,
    service_url,
    settings,
)
from tests.worker_by_hand import (
    finished_accuracy,
    finished_job,
    finished_study,
    finished_sweep,
    worker,
)


@pytest.fixture(scope="module", params=["blocking", "awaited"])
def connect(request):
    """Make a client of an address; what the tests ask of it is the specification of both."""
    if request.param == "blocking":
        yield Client
        return
    with asyncio.Runner() as runner:
        yield lambda *args, **kwargs: Driven(AsyncClient(*args, **kwargs), runner)


@pytest.fixture(scope="module")
def client(connect, service_url):
    with connect(service_url) as client:
        yield client
