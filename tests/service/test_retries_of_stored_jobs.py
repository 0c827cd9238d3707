"""Retries of what an earlier version admitted, with a field that is refused today."""

import copy
from collections.abc import Iterator
from dataclasses import replace
from typing import Any, NamedTuple

import httpx
import pytest

from jointplay.service.app import create_app
from jointplay.service.jobs.submission import checked
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import NewJob
from jointplay.storage.settings import Settings
from tests.service_in_thread import serving

PRESS = {"preset": "seven-bar-press", "parameters": {"stiffness": 1e10}}
JOB = {"kind": "simulate", "scene": PRESS, "duration": 0.125}
CHANNELS = ["displacement", "A.normal_force"]


class Service(NamedTuple):
    """A service and a catalogue of its own."""

    http: httpx.Client
    catalogue: Catalogue
    settings: Settings

    def stored(self, **changes: Any) -> NewJob:
        """Return a job as an earlier version might have filled it in."""
        new, _ = checked(JOB | {"channels": CHANNELS}, self.settings, 0.0)
        spec = copy.deepcopy(new.spec) | changes
        spec["scene"]["parameters"]["youngs_modulus"] = 7e10
        return replace(new, spec=spec, digest="0" * 64)

    def cancelled(self, new: NewJob) -> str:
        """Queue and cancel a job. Returns its id."""
        job = self.catalogue.submit(new).job.id
        self.http.post(f"/v1/jobs/{job}/cancel").raise_for_status()
        return job


@pytest.fixture
def service(tmp_path) -> Iterator[Service]:
    settings = Settings(data=tmp_path / "data")
    with (
        serving(create_app(settings)) as url,
        httpx.Client(base_url=url, trust_env=False, timeout=60) as http,
    ):
        catalogue = Catalogue(settings.catalogue_url)
        yield Service(http, catalogue, settings)
        catalogue.close()


def test_a_job_is_repeated_as_it_is_stored(service):
    new = service.stored()
    assert service.http.post("/v1/jobs", json=new.spec).status_code == 422
    answer = service.http.post(f"/v1/jobs/{service.cancelled(new)}/retry")
    assert answer.status_code == 202, answer.text
    assert answer.json()["job"] == new.spec


def test_so_are_the_jobs_of_a_batch(service):
    made = service.catalogue.submit_batch([service.stored(), service.stored(label="b")])
    for job in made.jobs:
        service.http.post(f"/v1/jobs/{job}/cancel").raise_for_status()
    answer = service.http.post(f"/v1/batches/{made.batch.id}/retry")
    assert answer.status_code == 202, answer.text
    jobs = service.http.get(answer.json()["links"]["jobs"]).json()["jobs"]
    assert [job["job"]["label"] for job in jobs] == ["", "b"]


def test_what_cannot_be_read_is_refused_with_what_is_wrong(service):
    job = service.cancelled(service.stored(channels=["slider7.gone"]))
    answer = service.http.post(f"/v1/jobs/{job}/retry")
    assert answer.status_code == 422
    pointers = [one["pointer"] for one in answer.json()["errors"]]
    assert pointers == ["/scene/parameters/youngs_modulus"]
