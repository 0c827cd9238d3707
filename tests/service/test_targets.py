"""Targets that name a whole address, and requests with two lengths (RFC 9112)."""

import json
import socket
from urllib.parse import urlsplit

import pytest


def answered(url: str, sent: bytes) -> list[bytes]:
    """Return all answers of a connection, which the service ends: status lines first."""
    with socket.create_connection((urlsplit(url).hostname, urlsplit(url).port)) as one:
        one.settimeout(60.0)
        one.sendall(sent)
        found = b"".join(iter(lambda: one.recv(65536), b""))
    return [b"HTTP/1.1 " + answer for answer in found.split(b"HTTP/1.1 ")[1:]]


@pytest.mark.parametrize(
    ("target", "host", "status"),
    [
        ("http://localhost/healthz", "localhost", 200),
        ("HTTP://127.0.0.1:8000/healthz", "localhost", 200),
        ("https://localhost/v1/jobs?page_size=1", "localhost", 200),  # as a proxy was asked
        ("http://localhost", "localhost", 200),
        ("http://localhost/v1/jobs", "evil.example", 200),  # the target's host counts
        ("http://evil.example/v1/jobs", "localhost", 403),
        ("http://localhost@evil.example/v1/jobs", "localhost", 403),
        ("http:///v1/jobs", "localhost", 403),
        ("http://localhost/v1/jobs/%2e%2e/nowhere", "localhost", 404),
        ("ftp://localhost/healthz", "localhost", 404),
    ],
)
def test_a_target_may_be_a_whole_address(
    service_url: str, target: str, host: str, status: int
) -> None:
    head = f"GET {target} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n\r\n"
    (answer,) = answered(service_url, head.encode())
    assert answer.startswith(f"HTTP/1.1 {status} ".encode()), answer


def test_a_request_with_two_lengths_is_the_last_of_its_connection(service_url: str) -> None:
    """A proxy may have taken the next one for its body."""
    head = "POST /v1/estimates HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n"
    lengths = "Content-Length: 5\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\n"
    hidden = "GET /healthz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n"
    (answer,) = answered(service_url, f"{head}{lengths}{hidden}".encode())
    assert answer.startswith(b"HTTP/1.1 400 ")
    assert json.loads(answer.partition(b"\r\n\r\n")[2])["type"] == "/problems/no-request"
