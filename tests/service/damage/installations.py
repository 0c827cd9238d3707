"""Services whose results are damaged: one with a folder, one with a bucket."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

import httpx

from jointplay.client import Client
from jointplay.service.app import create_app
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.settings import Settings
from tests.seaweedfs_server import BUCKET, running_store
from tests.service.damage.subjects import Subject, Subjects, computing
from tests.service_in_thread import client_of, serving
from tests.worker_by_hand import Worker


@dataclass
class Installation:
    """A service, its catalogue, and jobs of it to be damaged, each made when it is asked for."""

    http: httpx.Client
    client: Client
    catalogue: Catalogue
    subjects: Subjects
    _made: dict[str, Subject] = field(default_factory=dict)

    def subject(self, kind: str) -> Subject:
        """Return the job of a kind."""
        if kind not in self._made:
            self._made[kind] = self.subjects.made(kind)
        return self._made[kind]


@contextmanager
def in_folder(folder: Path) -> Iterator[Installation]:
    """Keep results, and files of jobs that run, in a folder."""
    with _installation(Settings(data=folder)) as made:
        yield made


@contextmanager
def in_bucket(folder: Path) -> Iterator[Installation]:
    """Keep both in a bucket."""
    with running_store() as endpoint:
        address = f"s3://{BUCKET}/damaged?endpoint={endpoint}"
        with _installation(Settings(data=folder, results_url=address)) as made:
            yield made


BACKENDS = {"folder": in_folder, "bucket": in_bucket}


@contextmanager
def _installation(settings: Settings) -> Iterator[Installation]:
    catalogue = Catalogue(settings.catalogue_url)
    with (
        serving(create_app(settings)) as url,
        client_of(url) as http,
        Client(url) as client,
    ):
        worker = Worker(http, catalogue, computing(settings))
        yield Installation(http, client, catalogue, Subjects(worker, catalogue, settings))
        catalogue.close()
