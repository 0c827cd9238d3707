"""A service that asks for keys, and what one owner has there."""

from collections.abc import Iterator
from dataclasses import dataclass

import httpx
import pytest

from jointplay.service.app import create_app
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.settings import Settings
from tests.service_in_thread import serving
from tests.worker_by_hand import Worker

SWING = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 1.0}
USUAL = ["jobs:write", "jobs:read", "results:read"]
IDS = {
    "quantity": "motion",
    "z": "0",
    "x": "0",
    "y": "0",
    "job_id": "",
    "batch_id": "",
    "key": "zarr.json",
    "name": "orbit",
    "form": "svg",
    "scene": "press",
}


@dataclass
class Guarded:
    """The service, and what one owner has there."""

    url: str
    catalogue: Catalogue
    job: str
    batch: str
    settings: Settings | None = None

    def key(self, owner: str, *scopes: str) -> str:
        return self.catalogue.make_key(owner, scopes or USUAL, "", None)[0]

    def as_(self, owner: str, *scopes: str) -> httpx.Client:
        headers = {"Authorization": f"Bearer {self.key(owner, *scopes)}"}
        return httpx.Client(base_url=self.url, headers=headers, trust_env=False, timeout=60)

    def path(self, template: str, **names: str) -> str:
        known = IDS | {"job_id": self.job, "batch_id": self.batch} | names
        return template.format(**known)

    def operations(self) -> Iterator[tuple[str, str]]:
        document = httpx.get(f"{self.url}/openapi.json", trust_env=False).json()
        for template, operations in document["paths"].items():
            yield from ((method.upper(), template) for method in operations)


@pytest.fixture(scope="session")
def guarded(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Guarded]:
    settings = Settings(data=tmp_path_factory.mktemp("data"), keys="required")
    with serving(create_app(settings)) as url:
        catalogue = Catalogue(settings.catalogue_url)
        catalogue.migrate()
        found = Guarded(url, catalogue, "", "", settings)
        with found.as_("ada") as http:
            worker = Worker(http, catalogue, settings)
            found.job = worker.finished()
            found.batch = http.post("/v1/batches", json={"jobs": [SWING]}).json()["id"]
        yield found
        catalogue.close()
