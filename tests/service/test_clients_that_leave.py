"""Clients that close their connection before they have said what they want."""

import logging
import socket
from pathlib import Path
from urllib.parse import urlsplit

import pytest

from jointplay.service.app import create_app
from jointplay.storage.settings import Settings
from tests.service_in_thread import serving
from tests.waiting import until

HALF = (
    b"POST /v1/jobs HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n"
    b"Content-Length: 100\r\n\r\n{"
)


def test_a_body_that_ends_too_early_is_no_failure_of_the_service(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    settings = Settings(data=tmp_path, log_format="json")
    with caplog.at_level(logging.INFO), serving(create_app(settings)) as url:
        address = urlsplit(url)
        with socket.create_connection((address.hostname, address.port)) as client:
            client.sendall(HALF)
        until(lambda: "POST /v1/jobs 4" in caplog.text)
    assert [line.message for line in caplog.records if line.levelname == "ERROR"] == []
