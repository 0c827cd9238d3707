"""Every route of the application, described or not: open to all, or to keys of one scope."""

import re
from collections.abc import Iterator
from contextlib import closing

import httpx
import pytest
from fastapi import FastAPI
from fastapi.routing import iter_route_contexts

from jointplay.service.app import create_app
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.keys import SCOPES
from jointplay.storage.settings import Settings
from tests.service_in_thread import serving

READING = {"GET", "HEAD"}
OPEN = {
    "/",
    "/docs",
    "/report",
    "/favicon.ico",
    "/page/{name:path}",
    "/openapi.json",
    "/healthz",
    "/readyz",
    "/problems",
    "/problems/{name}",
    "/v1/kinds",
    "/v1/laws",
    "/v1/scenes",
    "/v1/scenes/{name}",
    "/v1/schemas/scene.json",
}
"""Addresses that tell everybody the same."""
SCOPE = {
    "/metrics": "metrics",
    "/v1/usage": "jobs:read",
    "/v1/workers": "jobs:read",
    "/v1/estimates": "jobs:write",
    "/v1/scenes/check": "jobs:write",
    "/v1/scenes/drawing.{form}": "jobs:write",
    "/v1/scenes/poses": "jobs:read",
    "/v1/scenes/drag": "jobs:read",
    "/v1/scenes/channels": "jobs:read",
}
OF_JOBS = re.compile(r"/v1/(jobs(/{job_id}(/cancel|/retry|/report-mismatch|/events)?)?|batches.*)")


def scope_of(method: str, path: str) -> str:
    """The one scope, beside admin, that a route is for: of all others, reading results."""
    if OF_JOBS.fullmatch(path):
        return "jobs:read" if method in READING else "jobs:write"
    if path.startswith("/v1/worker/"):
        return "worker"
    return SCOPE.get(path, "results:read")


def routes(app: FastAPI) -> Iterator[tuple[str, str]]:
    for route in iter_route_contexts(app.routes):
        for method in route.methods or ():
            yield method, str(route.path)


@pytest.fixture(scope="module")
def guarded(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[str, dict[str, str]]]:
    """A service that asks for keys, and a key of each scope."""
    settings = Settings(data=tmp_path_factory.mktemp("data"), keys="required")
    with (
        serving(create_app(settings)) as url,
        closing(Catalogue(settings.catalogue_url)) as catalogue,
    ):
        catalogue.migrate()
        yield url, {scope: catalogue.make_key("ada", [scope], "", None)[0] for scope in SCOPES}


@pytest.mark.parametrize(("method", "path"), sorted(routes(create_app())))
def test_a_route_is_open_or_for_one_scope(
    guarded: tuple[str, dict[str, str]], method: str, path: str
) -> None:
    url, keys = guarded
    address = url + re.sub(r"{.*?}", "x", path)
    with httpx.Client(trust_env=False, timeout=60) as http:
        unknown = http.request(method, address).status_code
        if path in OPEN and method in READING:
            assert unknown in {200, 404}
            return
        assert unknown == 401
        answers = {
            scope: http.request(method, address, headers={"Authorization": f"Bearer {key}"})
            for scope, key in keys.items()
        }
    assert not {401, 500} & {answer.status_code for answer in answers.values()}
    opened = {scope for scope, answer in answers.items() if answer.status_code != 403}
    assert opened == {scope_of(method, path), "admin"}
