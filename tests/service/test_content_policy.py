"""Browsers take every answer for what it says it is, and carry out nothing in it."""

import pytest
from httpx import Client

from tests.service.guarded import Guarded

PATHS = [
    "/v1/jobs/{job_id}",
    "/v1/jobs/{job_id}/events",
    "/v1/jobs/{job_id}/history",
    "/v1/jobs/{job_id}/figures/orbit.svg",
    "/v1/jobs/{job_id}/figures/orbit.pdf",
    "/v1/jobs/{job_id}/zarr/zarr.json",
    "/v1/jobs/{job_id}/zarr.zip",
    "/v1/jobs/none",
    "/openapi.json",
    "/healthz",
    "/nothing",
]


@pytest.mark.parametrize("path", PATHS)
def test_no_answer_is_taken_for_something_else(guarded: Guarded, path: str) -> None:
    with guarded.as_("ada") as ada:
        answer = ada.get(guarded.path(path))
        assert answer.headers["X-Content-Type-Options"] == "nosniff"
        policy = answer.headers["Content-Security-Policy"]
        assert "default-src 'none'" in policy
        assert "script-src" not in policy
        assert answer.headers.get_list("Content-Security-Policy") == [policy]


def test_the_page_has_a_policy_of_its_own(http: Client) -> None:
    answer = http.get("/")
    assert answer.headers["X-Content-Type-Options"] == "nosniff"
    assert "script-src 'self'" in answer.headers["Content-Security-Policy"]
    assert len(answer.headers.get_list("Content-Security-Policy")) == 1
