"""An error that nobody expected is answered like any other: with a document, headers and an id."""

import asyncio
from pathlib import Path

import httpx

from jointplay.service.app import create_app
from jointplay.storage.settings import Settings

SECRET = "what nobody should see"


def test_an_unexpected_error_has_the_headers_of_every_answer(
    tmp_path: Path,
) -> None:
    app = create_app(Settings(data=tmp_path, log_format="json"))

    async def break_down() -> None:
        raise ArithmeticError(SECRET)

    app.add_api_route("/broken", break_down)
    headers = {"X-Request-Id": "a-proxy.1"}

    async def ask() -> httpx.Response:
        transport = httpx.ASGITransport(app)  # it raises what is not answered
        async with httpx.AsyncClient(transport=transport, base_url="http://here") as client:
            return await client.get("/broken", headers=headers)

    answer = asyncio.run(ask())
    assert answer.status_code == 500
    assert answer.json()["type"] == "/problems/internal-error"
    assert SECRET not in answer.text
    assert answer.headers["X-Content-Type-Options"] == "nosniff"
    assert "default-src 'none'" in answer.headers["Content-Security-Policy"]
    assert answer.headers["X-Request-Id"] == "a-proxy.1"
