"""Hosts and origins that a service without keys answers, and those that it does not."""

import json
from collections.abc import Iterator

import httpx
import pytest

from jointplay.service.app import create_app
from jointplay.storage.settings import Settings
from tests.service_in_thread import serving


@pytest.mark.parametrize(
    ("headers", "status"),
    [
        ({}, 200),
        ({"Host": "localhost:1"}, 200),
        ({"Host": "[::1]:8000"}, 200),
        ({"Host": "192.168.1.7:8000"}, 200),
        ({"Host": "lab.example"}, 200),
        ({"Host": "evil.example"}, 403),
        ({"Host": "localhost.evil.example"}, 403),
        ({"Host": "[::1"}, 403),
        ({"Host": "[::1].evil.example"}, 403),
        ({"Host": "[::1].evil.example:8000"}, 403),
        ({"Host": "[::1]evil.example"}, 403),
        ({"Host": "[::1]:evil.example"}, 403),
        ({"Host": "localhost@evil.example"}, 403),
        ({"Host": "http://localhost"}, 403),
        ({"Host": "[::1]"}, 200),
        ({"Host": "localhost:"}, 200),
        ({"Host": "localhost:8000", "Origin": "http://localhost:8000"}, 200),
        ({"Host": "[::1]:8000", "Origin": "http://[::1]:8000"}, 200),
        ({"Host": "localhost", "Origin": "https://localhost"}, 200),  # behind a proxy with TLS
        ({"Host": "localhost:8000", "Origin": "http://localhost:3000"}, 403),
        ({"Host": "localhost:8000", "Origin": "http://localhost"}, 403),
        ({"Host": "localhost:8000", "Origin": "http://127.0.0.1:8000"}, 403),
        ({"Origin": "http://localhost:3000"}, 403),
        ({"Origin": "https://lab.example"}, 200),
        ({"Host": "lab.example", "Origin": "https://lab.example:8443"}, 200),
        ({"Host": "192.168.1.7:8000", "Origin": "http://192.168.1.7:8000"}, 200),
        ({"Origin": "http://[::1].evil.example"}, 403),
        ({"Origin": "http://6.6.6.6"}, 403),
        ({"Origin": "http://evil.example"}, 403),
        ({"Origin": "null"}, 403),
    ],
    ids=json.dumps,
)
def test_pages_of_others_are_refused_where_no_key_is_asked_for(
    keyless: str, headers: dict[str, str], status: int
) -> None:
    answer = httpx.get(f"{keyless}/v1/jobs", headers=headers, trust_env=False)
    assert answer.status_code == status
    if status == 403:
        assert answer.json()["type"] == "/problems/foreign-host"


@pytest.fixture(scope="module")
def keyless(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    settings = Settings(data=tmp_path_factory.mktemp("data"), hosts="lab.example, other.example")
    with serving(create_app(settings)) as url:
        yield url
