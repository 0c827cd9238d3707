"""Query parameters that an address does not have, or that it is given twice."""

from collections.abc import Iterator
from itertools import product
from string import ascii_lowercase

import httpx
import pytest
from fastapi import FastAPI
from fastapi.routing import iter_route_contexts

from tests.service.test_every_route import OPEN


def locked(app: FastAPI) -> Iterator[tuple[str, str]]:
    for route in iter_route_contexts(app.routes):
        for method in route.methods or ():
            if str(route.path) not in OPEN:
                yield method, str(route.path)


def test_no_address_overlooks_a_parameter(
    application: FastAPI, http: httpx.Client, finished_job: str
) -> None:
    """Who asks POST /v1/jobs?wait=30, say, would take the answer for that of an ended job."""
    told = set()
    for method, path in locked(application):
        address = path.replace("{job_id}", finished_job).replace(":path", "")
        answer = http.request(method, f"{address}?nonsense=1", json={})
        assert 400 <= answer.status_code < 500, (method, path)
        if method != "HEAD" and "There is no parameter 'nonsense' here" in answer.text:
            told.add((method, path))
    assert {
        ("POST", "/v1/jobs"),
        ("DELETE", "/v1/jobs/{job_id}"),
        ("POST", "/v1/batches/{batch_id}/cancel"),
        ("GET", "/v1/jobs/{job_id}/statistics"),
        ("GET", "/v1/usage"),
        ("POST", "/v1/worker/claims"),
    } <= told
    assert len(told) > 40


@pytest.mark.parametrize(
    ("address", "name"),
    [
        ("/v1/jobs/{job}/history?channels=slider7.x&channels=slider7.y", "channels"),
        ("/v1/jobs/{job}/history?start=0&stop=1&start=0.5", "start"),
        ("/v1/jobs?state=queued&state=running", "state"),
        ("/v1/jobs/{job}?wait=1&wait=2", "wait"),
    ],
)
def test_a_parameter_that_is_given_twice_is_refused(
    http: httpx.Client, finished_job: str, address: str, name: str
) -> None:
    """Libraries write a list as the same name again and again, of which the last one counted."""
    answer = http.get(address.format(job=finished_job))
    assert answer.status_code == 422
    (error,) = answer.json()["errors"]
    assert error["parameter"] == name
    assert error["detail"].startswith(f"'{name}' is given more than once")


@pytest.mark.parametrize("path", ["/v1/jobs", "/v1/workers"])
def test_of_many_wrong_parameters_a_hundred_are_told(http: httpx.Client, path: str) -> None:
    names = ["".join(letters) for letters in product(ascii_lowercase, repeat=3)]
    answer = http.get(f"{path}?{'&'.join(names[:10_000])}")
    assert answer.status_code == 422
    assert len(answer.json()["errors"]) == 100
    assert len(answer.content) < 100_000
