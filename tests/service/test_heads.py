"""HEAD: what GET says of its answer, without the answer (RFC 9110, sections 9.3.2 and 14.2)."""

import logging

import httpx
import pytest
from fastapi import FastAPI
from fastapi.routing import iter_route_contexts

from jointplay.service.app import create_app
from jointplay.storage.settings import Settings
from tests.service_in_thread import client_of, serving

PATHS = (
    "/",
    "/healthz",
    "/readyz",
    "/openapi.json",
    "/metrics",
    "/v1/jobs",
    "/v1/jobs/{job}",
    "/v1/jobs/{job}/history",
    "/v1/jobs/{job}/figures",
    "/v1/jobs/{job}/figures/outputs.svg",
    "/v1/jobs/{job}/zarr",
    "/v1/jobs/{job}/zarr/zarr.json",
    "/v1/jobs/{job}/zarr.zip",
    "/v1/jobs/none",
    "/v1/batches/none",
    "/nothing",
)
OF_THE_MOMENT = {"date", "content-length", "transfer-encoding"}


@pytest.mark.parametrize("path", PATHS)
def test_head_has_the_head_of_get(http: httpx.Client, finished_job: str, path: str) -> None:
    address = path.format(job=finished_job)
    head, get = http.head(address), http.get(address)
    assert head.status_code == get.status_code
    assert head.content == b""
    told = [{k: v for k, v in one.headers.items() if k not in OF_THE_MOMENT} for one in (head, get)]
    assert told[0] == told[1]
    if path != "/metrics":  # whose numbers grow
        assert head.headers.get("content-length") == get.headers.get("content-length")


def test_every_address_that_knows_get_knows_head(application: FastAPI, http: httpx.Client) -> None:
    paths = {
        str(route.path)
        for route in iter_route_contexts(application.routes)
        if "GET" in route.methods
    }
    assert len(paths) > 40
    for path in paths:
        named = path.replace("{", "").replace("}", "").replace(":path", "")
        assert http.head(named).status_code != 405, path


def test_the_events_of_a_job_that_waits_are_not_waited_for(http: httpx.Client, worker) -> None:
    head = http.head(f"/v1/jobs/{worker.submit()}/events")
    assert head.status_code == 200
    assert head.headers["Content-Type"].startswith("text/event-stream")
    assert http.get("/healthz").status_code == 200  # on the same connection


@pytest.mark.parametrize("behind", ["zarr.zip", "zarr/zarr.json", "zarr/time/c/0"])
@pytest.mark.parametrize("asked", ["bytes=0-9", "bytes=999999999-"])
def test_a_range_means_nothing_in_a_head(
    http: httpx.Client, finished_job: str, behind: str, asked: str
) -> None:
    address = f"/v1/jobs/{finished_job}/{behind}"
    part, whole = http.head(address, headers={"Range": asked}), http.head(address)
    assert part.status_code == 200
    assert "content-range" not in part.headers
    assert part.headers["content-length"] == whole.headers["content-length"]


def test_the_log_tells_method_and_route(tmp_path, caplog: pytest.LogCaptureFixture) -> None:
    app = create_app(Settings(data=tmp_path, log_format="json"))
    with caplog.at_level(logging.INFO, "jointplay"), serving(app) as url, client_of(url) as http:
        assert http.head("/v1/jobs/none").status_code == 404
    assert "HEAD /v1/jobs/{job_id} 404" in [one.getMessage() for one in caplog.records]


def test_a_method_that_is_not_known_is_told_of_head(http: httpx.Client) -> None:
    assert http.put("/healthz").headers["Allow"] == "GET, HEAD"
