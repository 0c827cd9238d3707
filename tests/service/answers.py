"""Answers of the service, checked for what all have."""

from typing import Any

import httpx


def get(http: httpx.Client, path: str, status: int = 200, **query: Any) -> dict[str, Any]:
    answer = http.get(path, params=query)
    assert answer.status_code == status, answer.text
    kind = "application/json" if status < 400 else "application/problem+json"
    assert answer.headers["Content-Type"] == kind
    document: dict[str, Any] = answer.json()
    return document
