"""A whole service in this process: a client asks over HTTP, and a worker is called by hand."""

import threading
from collections.abc import Iterator
from typing import Any

import pytest

from jointplay.client import Client, Job
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.settings import Settings
from jointplay.worker.block_run import BlockRun
from tests.service_in_thread import application, catalogue, http, service_url, settings


class Platform:
    """Takes a job from its document to its results as users see them."""

    def __init__(self, client: Client, catalogue: Catalogue, settings: Settings) -> None:
        self.client, self.catalogue, self.settings = client, catalogue, settings

    def computed(self, document: dict[str, Any]) -> Job:
        """Submit a job, have its blocks run, and return it as the client sees it at its end."""
        job = self.client.submit(document | {"cache": False})
        while not job.refresh().is_finished:
            for block in self.catalogue.blocks(job.id):
                claim = self.catalogue.claim_block(block.id, "this process", 60.0)
                if claim is not None:
                    BlockRun(self.catalogue, self.settings, claim, threading.Event()).run()
        return job


@pytest.fixture(scope="session")
def platform(service_url: str, catalogue: Catalogue, settings: Settings) -> Iterator[Platform]:
    with Client(service_url) as client:
        yield Platform(client, catalogue, settings)
