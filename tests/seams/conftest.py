"""A whole service in this process: a client asks over HTTP, and a worker is called by hand."""

import threading
from collections.abc import Iterator
from typing import Any

import pytest

from jointplay.client import Client, Job
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.settings import Settings
from jointplay.worker.block_run import BlockRun
from tests.page.conftest import browsing
from tests.service_in_thread import application, catalogue, http, service_url, settings


class Platform:
    """Takes a job from its document to its results as users see them."""

    def __init__(self, client: Client, catalogue: Catalogue, settings: Settings) -> None:
        self.client, self.catalogue, self.settings = client, catalogue, settings

    def computed(self, document: dict[str, Any]) -> Job:
        """Submit a job, have its blocks run, and return it as the client sees it at its end."""
        return self.finished(self.client.submit(document | {"cache": False}))

    def finished(self, job: Job) -> Job:
        """Have the blocks of a job run, and return it at its end."""
        while not job.refresh().is_finished:
            for block in self.catalogue.blocks(job.id):
                self.compute(block.id)
        return job

    def compute(self, block: str) -> None:
        """Run one block, unless it has been."""
        claim = self.catalogue.claim_block(block, "this process", 60.0)
        if claim is not None:
            BlockRun(self.catalogue, self.settings, claim, threading.Event()).run()


@pytest.fixture(scope="session")
def platform(service_url: str, catalogue: Catalogue, settings: Settings) -> Iterator[Platform]:
    with Client(service_url) as client:
        yield Platform(client, catalogue, settings)
