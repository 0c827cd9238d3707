"""Requests made from the OpenAPI document: no failure of ours, and nothing that breaks it."""

import zlib
from collections.abc import Iterator, Mapping
from typing import Any

import httpx
import hypothesis.strategies as st
import pytest
import schemathesis
from hypothesis import HealthCheck, Phase, given, settings
from schemathesis import GenerationMode
from schemathesis.checks import not_a_server_error
from schemathesis.specs.openapi.checks import (
    allow_header_conformance,
    content_type_conformance,
    response_headers_conformance,
    response_schema_conformance,
    status_code_conformance,
)

from jointplay.records.job import JobError
from jointplay.service.app import create_app
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import BlockState
from jointplay.storage.settings import Settings
from tests.service_in_thread import serving
from tests.worker_by_hand import ACCURACY_STUDY, BIFURCATION, CHART, SENSITIVITY, SWEEP, Worker

CHECKS = (
    not_a_server_error,
    status_code_conformance,
    content_type_conformance,
    response_headers_conformance,
    response_schema_conformance,
    allow_header_conformance,
)
DESTROYING = {"DELETE", "POST"}
Known = Mapping[str, tuple[str, ...]]


@pytest.fixture(scope="module")
def known(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[str, Known, Known]]:
    """A service, what its paths may name, and what those that change something may."""
    own = Settings(data=tmp_path_factory.mktemp("service"))
    with (
        serving(create_app(own)) as url,
        httpx.Client(base_url=url, trust_env=False, timeout=60) as http,
    ):
        catalogue = Catalogue(own.catalogue_url)
        worker = Worker(http, catalogue, own)
        kept = (
            worker.finished(),
            worker.finished_study(**BIFURCATION),
            worker.finished_study(**SWEEP),
            worker.finished_study(**ACCURACY_STUDY),
            worker.finished_study(**CHART),
            worker.finished_study(**SENSITIVITY),
        )
        failed = worker.start(worker.submit())
        worker.finish(failed, BlockState.failed, JobError("solver", "x", "X."))
        deleted = worker.finished()
        http.delete(f"/v1/jobs/{deleted}").raise_for_status()
        kept += failed.job.id, deleted
        job = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 1.0}
        batch = http.post("/v1/batches", json={"jobs": [job]}).json()["id"]
        keys = "zarr.json", "time/c/0", "peaks/zarr.json", "pyramid/zarr.json", "../zarr.json"
        names = {
            "batch_id": (batch,),
            "key": keys,
            "name": (
                "orbit",
                "displacement",
                "bifurcation",
                "sweep",
                "sensitivity",
                "work-precision",
                "invalid-job",
            ),
            "form": ("png", "svg"),
            "quantity": ("motion", "steps"),
            "z": ("0", "1"),
            "x": ("0", "1"),
            "y": ("0",),
        }
        spare = worker.finished(), worker.submit()
        yield url, {**names, "job_id": kept}, {**names, "job_id": spare}
        catalogue.close()


DESCRIBED = schemathesis.openapi.from_dict(create_app().openapi())
OPERATIONS = {found.ok().label: found.ok() for found in DESCRIBED.get_all_operations()}
SOME = settings(
    max_examples=4,  # of each of fifty operations
    derandomize=True,
    database=None,
    phases=[Phase.generate],  # a request that fails says enough; making it smaller takes minutes
    deadline=None,
    suppress_health_check=list(HealthCheck),
)


def requests_to(label: str) -> st.SearchStrategy[Any]:
    """Return requests as they are described, and such as are not."""
    operation = OPERATIONS[label]
    return st.one_of(
        operation.as_strategy(generation_mode=mode)
        for mode in (GenerationMode.POSITIVE, GenerationMode.NEGATIVE)
    )


def sent(case: Any, known: tuple[str, Known, Known]) -> None:
    """Send a request, most of the time for something that is there, and check the answer."""
    url, kept, spare = known
    names = spare if case.method.upper() in DESTROYING else kept
    for name, generated in case.path_parameters.items():
        number = zlib.crc32(repr((generated, case.query)).encode())
        if number % 5:
            case.path_parameters[name] = names[name][number % len(names[name])]
    if "wait" in str(case.headers.get("prefer")):
        del case.headers["prefer"]  # nobody computes what is submitted here
    case.call_and_validate(base_url=url, checks=CHECKS, timeout=60)


@pytest.mark.parametrize("label", OPERATIONS)
@SOME
@given(data=st.data())
def test_some_requests(label: str, data: st.DataObject, known: tuple[str, Known, Known]) -> None:
    sent(data.draw(requests_to(label)), known)


@pytest.mark.long
@pytest.mark.parametrize("label", OPERATIONS)
@settings(SOME, max_examples=200, derandomize=False)
@given(data=st.data())
def test_many_requests(label: str, data: st.DataObject, known: tuple[str, Known, Known]) -> None:
    sent(data.draw(requests_to(label)), known)
