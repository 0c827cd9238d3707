"""Descriptions that the service gives of itself: health, scenes, problems, the OpenAPI document."""

import json
import re
import shutil
from pathlib import Path
from typing import Any

import httpx
import pytest

from jointplay.records.strict_json import DEEPEST
from jointplay.service import body, fair_queue, fair_semaphore, owners, pieces
from jointplay.service.access import concurrency
from jointplay.service.app import create_app
from jointplay.service.body import LARGEST_BATCH, LARGEST_BODY
from jointplay.service.processes import connection_limit, connections
from jointplay.service.processes.api import LONGEST_HEAD
from jointplay.service.results.queries import MOST_VALUES
from jointplay.solver.kinds import KINDS
from jointplay.solver.kinds.limits import (
    LONGEST_IDEAL_RUN,
    LONGEST_RUN,
    MOST_BYTES,
    MOST_FIXED_STEPS,
    MOST_GEOMETRIES,
    MOST_OF_A_CHART,
    MOST_PERIODS,
    MOST_POINTS,
    MOST_SAMPLES,
)
from jointplay.solver.scene import presets
from jointplay.solver.scene.schema import scene_schema
from jointplay.storage.settings import Settings
from tests.presets_given import REQUIRED
from tests.service_in_thread import client_of, serving
from tests.waiting import until


def test_a_service_that_is_up_is_alive_and_ready(http):
    assert http.get("/healthz").json() == {"status": "ok"}
    assert http.get("/readyz").json() == {"status": "ok"}


def test_a_service_without_its_folder_is_alive_but_not_ready(tmp_path):
    settings = Settings(data=tmp_path / "data")
    with (
        serving(create_app(settings)) as url,
        httpx.Client(base_url=url, trust_env=False, timeout=60) as http,
    ):
        assert http.get("/readyz").status_code == 200
        shutil.rmtree(settings.data)
        until(lambda: not http.get("/readyz").is_success)
        answer = http.get("/readyz")
        assert answer.status_code == 503
        assert answer.headers["Retry-After"] == "5"
        assert answer.json()["type"] == "/problems/unavailable"
        assert http.get("/healthz").status_code == 200


def test_every_scene_is_listed_with_its_parameters_and_can_be_fetched(http):
    scenes = http.get("/v1/scenes").json()["scenes"]
    assert [scene["name"] for scene in scenes] == presets.names()
    for scene in scenes:
        assert scene["parameters"]
        document = http.get(scene["link"]).json()
        assert document["bodies"].keys() == presets.document(scene["name"])["bodies"].keys()


def test_a_fetched_scene_is_a_scene(http):
    for name in presets.names():
        scene = http.get(f"/v1/scenes/{name}").json()
        for parameter, value in REQUIRED.get(name, {}).items():
            scene["parameters"][parameter]["default"] = value
        answer = http.post("/v1/jobs", json={"kind": "simulate", "scene": scene, "duration": 0.1})
        assert answer.status_code in {200, 202}, answer.text


def test_the_schema_of_a_scene_is_served_as_one(http):
    answer = http.get("/v1/schemas/scene.json")
    assert answer.headers["Content-Type"] == "application/schema+json"
    assert answer.json() == scene_schema()


def test_an_unknown_scene_is_not_found_and_near_ones_are_named(http):
    answer = http.get("/v1/scenes/pendulumm")
    assert answer.status_code == 404
    assert "pendulum" in answer.json()["errors"][0]["detail"]


def test_every_kind_of_problem_is_explained(http):
    for problem in http.get("/problems").json()["problems"]:
        explained = http.get(problem["type"]).json()
        assert explained == problem
        assert len(explained["help"]) > 20
    assert http.get("/problems/none").status_code == 404


def test_an_address_that_does_not_exist_and_a_wrong_method_are_problems(http):
    for answer, status in ((http.get("/v2"), 404), (http.delete("/v1/jobs"), 405)):
        assert answer.status_code == status
        assert answer.headers["Content-Type"] == "application/problem+json"
    assert "Allow" in answer.headers


@pytest.fixture(scope="module")
def openapi(http) -> dict[str, Any]:
    document: dict[str, Any] = http.get("/openapi.json").json()
    return document


def test_the_job_in_the_openapi_document_carries_units(openapi):
    body = openapi["paths"]["/v1/jobs"]["post"]["requestBody"]["content"]["application/json"]
    schemas = openapi["components"]["schemas"]
    assert body["schema"] == {"$ref": "#/components/schemas/JobDocument"}
    kinds = schemas["JobDocument"]["discriminator"]["mapping"]
    assert kinds.keys() == KINDS.keys()
    assert schemas["SimulateJob"]["properties"]["duration"]["unit"] == "s"
    assert schemas["BifurcationJob"]["properties"]["settle"]["unit"] == "periods"
    batch = openapi["paths"]["/v1/batches"]["post"]["requestBody"]["content"]["application/json"]
    assert batch["schema"] == {"$ref": "#/components/schemas/BatchDocument"}
    jobs = schemas["BatchDocument"]["properties"]["jobs"]
    assert (jobs["items"], jobs["maxItems"]) == (body["schema"], 10_000)
    impact = openapi["components"]["schemas"]["Impact"]["properties"]
    assert {name: one.get("unit") for name, one in impact.items()} == {
        "joint": None,
        "onset": "s",
        "release": "s",
        "approach_rate": "m/s",
        "peak_force": "N",
        "impulse": "N s",
    }


def test_every_reference_in_the_openapi_document_resolves(openapi):
    schemas = openapi["components"]["schemas"]
    references = re.findall(r"'\$ref': '([^']+)'", str(openapi))
    assert len(references) > len(schemas)
    for reference in references:
        assert reference.removeprefix("#/components/schemas/") in schemas


def test_every_operation_says_what_it_answers_and_what_it_does(openapi):
    for path, operations in openapi["paths"].items():
        for method, operation in operations.items():
            assert operation["description"], (method, path)
            success = next(v for k, v in operation["responses"].items() if k.startswith("2"))
            assert success["content"], (method, path)
            for status, answer in operation["responses"].items():
                if status.startswith(("4", "5")):
                    assert list(answer["content"]) == ["application/problem+json"], (path, status)


def test_the_problem_that_the_documentation_shows_is_the_one_that_is_sent(http):
    documentation = (Path(__file__).parents[2] / "docs" / "http.md").read_text()
    shown = json.loads(re.findall(r"```json\n(.*?)```", documentation, re.DOTALL)[0])
    scene = {"preset": "seven-bar-press", "parameters": {"clearance": -1.0}}
    job = {"kind": "simulate", "scene": scene, "duration": 2.0}
    assert http.post("/v1/jobs", json=job).json() == shown


def test_the_documentation_gives_the_limits_that_hold():
    documentation = (Path(__file__).parents[2] / "docs" / "http.md").read_text()
    assert f"headers of a request | {LONGEST_HEAD // 2**10} KiB" in documentation
    assert f"| a body | {LARGEST_BODY // 2**20} MiB" in documentation
    assert f"of a batch {LARGEST_BATCH // 2**20} MiB" in documentation
    assert f"| its JSON | {DEEPEST} levels" in documentation
    assert MOST_VALUES == 1_000_000
    assert "one million values" in documentation
    assert (LONGEST_RUN, LONGEST_IDEAL_RUN) == (1e6, 100.0)
    assert "a million periods (100 of an ideal mechanism that does not come back" in documentation
    assert (MOST_FIXED_STEPS, MOST_SAMPLES, MOST_BYTES) == (4e9, 10**8, 10**10)
    assert "4·10⁹ steps of `rk4`, 10⁸ samples, 10 GB" in documentation
    assert (MOST_POINTS, MOST_OF_A_CHART, MOST_PERIODS) == (100_000, 4_000_000, 1e8)
    assert "100 000 points (`basin-stability` 4 million), 10⁸ periods" in documentation
    assert f"{MOST_GEOMETRIES} geometries" in documentation


def test_the_documentation_gives_the_bounds_of_what_is_done_at_once():
    documentation = (Path(__file__).parents[2] / "docs" / "http.md").read_text()
    _, _, told = documentation.partition("| what | at most at once | beyond it |\n|---|---|---|\n")
    table, _, others = told.partition("\n\n")
    of_address = int(connection_limit.SHARE * connection_limit.MOST)
    assert [row.split(" | ")[1] for row in table.splitlines()] == [
        f"{connection_limit.MOST}, or half as many as the process may have open files",
        f"three quarters of these: {of_address}",
        f"{concurrency.MOST}; of these {concurrency.OF_HEALTH} only for health and readiness, "
        f"{concurrency.OF_WORKERS} more only for these and for workers with a block",
        f"{concurrency.WITHOUT_KEY}; where keys are required {concurrency.BESIDE_KEYS}",
        f"{owners.OF_ONE}, and as many of workers with a block",
        f"{owners.WAITING} (where no key is asked for: of all callers together)",
        f"{body.MOST_TOGETHER // 2**20} MiB together",
        f"{pieces.MOST_TOGETHER // 2**20} MiB together",
        f"{fair_semaphore.DRAWN_AT_ONCE}",
        f"{fair_semaphore.EXPORTED_AT_ONCE}",
        f"{fair_semaphore.LISTED_AT_ONCE}",
        f"{fair_queue.OF_ONE} of a kind; of all kinds together no more than are left of the"
        f" {fair_queue.MOST_EVERYWHERE} of all owners",
    ]
    assert table.count(f"of more than {body.SHORT // 1024} KiB") == 2
    assert body.SHORT == pieces.LONGEST
    assert f"head of its request within {connections.HEAD_PATIENCE:g} s" in others
    assert f"takes nothing of its answer for {connections.READER_PATIENCE:g} s" in others
    assert f"not agreed on TLS within {connections.HEAD_PATIENCE:g} s" in others
    assert f"within {body.PATIENCE:g} s, and {1e6 / body.SLOWEST:g} s more for each me" in others
    assert f"share its {of_address} connections" in others
    assert f"[{owners.WAITING} waiting requests]" in documentation


def test_the_documentation_lists_every_address(openapi):
    documentation = (Path(__file__).parents[2] / "docs" / "http.md").read_text()
    for path in openapi["paths"]:
        last = path.replace("{name}.{form}", "{name}.png").replace("{job_id}", "{id}")
        if last.startswith("/problems"):
            continue
        shorter = last.replace("/v1/jobs/{id}/figures/", "…/figures/")
        assert (
            f"{last}`" in documentation or f"{last}?" in documentation or shorter in documentation
        )


def test_an_unknown_method_is_told_the_known_ones_without_the_description(
    fresh_service: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The description takes a second, for which nobody else would be answered."""
    monkeypatch.delattr("jointplay.service.description.get_openapi")
    with client_of(fresh_service) as http:
        answer = http.delete("/v1/jobs")
        of_keys = http.post("/v1/jobs/x/zarr/values/zarr.json")
    assert (answer.status_code, answer.headers["Allow"]) == (405, "GET, HEAD, POST")
    assert of_keys.headers["Allow"] == "GET, HEAD"
