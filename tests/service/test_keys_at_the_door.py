"""A service that asks for keys: who may do what, and that others' jobs are not there."""

import os
import subprocess
import sys
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path

import httpx
import numpy as np
import pytest
import xarray

from jointplay.client import Client, ClientError
from jointplay.service import events
from jointplay.service.access import authentication
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.keys import Key
from tests.postgresql_server import running_server
from tests.service.guarded import SWING, Guarded

OPEN = ("/healthz", "/readyz", "/v1/scenes", "/v1/kinds", "/v1/laws", "/v1/schemas", "/problems")


def test_nothing_but_what_is_the_same_for_all_opens_without_a_key(guarded: Guarded) -> None:
    with httpx.Client(base_url=guarded.url, trust_env=False, timeout=60) as http:
        refused = 0
        for method, template in guarded.operations():
            answer = http.request(method, guarded.path(template))
            if method == "GET" and template.startswith(OPEN):
                assert answer.status_code != 401, template
                continue
            refused += 1
            assert answer.status_code == 401, (method, template)
            assert answer.headers["WWW-Authenticate"].startswith("Bearer")
            assert answer.json()["type"] == "/problems/key-missing"
        assert refused > 20


@pytest.mark.parametrize(
    "header", ["", "Bearer", "Basic eDp5", "Bearer jp_00000000_x", f"Bearer jp_0a1b2c3d_{'A' * 43}"]
)
def test_what_is_no_key_opens_nothing(guarded: Guarded, header: str) -> None:
    headers = {"Authorization": header}
    answer = httpx.get(f"{guarded.url}/v1/jobs", headers=headers, trust_env=False)
    assert answer.status_code == 401
    key = guarded.key("ada")
    wrong = {"Authorization": f"Bearer {key[:-4]}AAAA"}
    assert httpx.get(f"{guarded.url}/v1/jobs", headers=wrong, trust_env=False).status_code == 401


def test_what_others_have_is_not_there(guarded: Guarded) -> None:
    with guarded.as_("bob") as bob, guarded.as_("ada") as ada:
        seen = 0
        for method, template in guarded.operations():
            if "{job_id}" not in template and "{batch_id}" not in template:
                continue
            seen += 1
            path = guarded.path(template)
            answer = bob.request(method, path)
            assert answer.status_code == 404, (method, template)
            nobodys = guarded.path(template, job_id="0" * 26, batch_id="0" * 26)
            same = bob.request(method, nobodys)
            assert answer.json()["type"] == same.json()["type"]
            if method == "GET":
                assert ada.get(path).status_code != 401
        assert seen > 15
        assert bob.get("/v1/jobs").json()["jobs"] == []
        assert len(ada.get("/v1/jobs").json()["jobs"]) == 2
        assert ada.get(f"/v1/jobs/{guarded.job}").json()["state"] == "succeeded"
        assert ada.get(f"/v1/batches/{guarded.batch}").json()["jobs"] == 1


def test_an_administrator_sees_all(guarded: Guarded) -> None:
    with guarded.as_("root", "admin") as http:
        assert len(http.get("/v1/jobs").json()["jobs"]) >= 2
        assert http.get(f"/v1/jobs/{guarded.job}").status_code == 200
        assert http.get(f"/v1/jobs/{guarded.job}/peaks").status_code == 200


@pytest.mark.parametrize(
    ("scope", "open_to"),
    [("jobs:read", "look"), ("jobs:write", "send"), ("results:read", "results"), ("metrics", "")],
)
def test_a_key_is_for_its_scopes(guarded: Guarded, scope: str, open_to: str) -> None:
    acts: dict[str, Callable[[httpx.Client], httpx.Response]] = {
        "look": lambda http: http.get(f"/v1/jobs/{guarded.job}"),
        "send": lambda http: http.post("/v1/jobs", json=SWING),
        "results": lambda http: http.get(f"/v1/jobs/{guarded.job}/zarr/zarr.json"),
    }
    with guarded.as_("ada", scope) as http:
        for name, act in acts.items():
            answer = act(http)
            if name == open_to:
                assert answer.is_success
            else:
                assert answer.status_code == 403
                assert answer.json()["type"] == "/problems/scope-missing"
                assert scope in answer.json()["detail"]


def test_equal_jobs_and_equal_idempotency_keys_of_two_owners_are_two(guarded: Guarded) -> None:
    with guarded.as_("carl") as carl, guarded.as_("dora") as dora:
        headers = {"Idempotency-Key": "the-same"}
        made = [http.post("/v1/jobs", json=SWING, headers=headers) for http in (carl, dora)]
        assert [one.status_code for one in made] == [202, 202]
        assert made[0].json()["id"] != made[1].json()["id"]
        again = carl.post("/v1/jobs", json=SWING, headers=headers).json()
        assert again["id"] == made[0].json()["id"]
        other = carl.post("/v1/jobs", json=SWING | {"duration": 2.0}, headers=headers)
        assert other.status_code == 422
        assert "the-same" in other.json()["detail"]


def test_a_revoked_key_opens_nothing(guarded: Guarded, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(authentication, "_REMEMBERED", 0.0)
    with guarded.as_("ada") as http:
        assert http.get("/v1/jobs").status_code == 200
        used = [key for key in guarded.catalogue.all_keys() if key.last_used is not None]
        name = http.headers["Authorization"].split("_")[1]
        assert name in {key.id for key in used}
        guarded.catalogue.revoke_key(name)
        assert http.get("/v1/jobs").status_code == 401


def test_a_key_that_is_not_there_is_looked_up_once_in_a_while(
    guarded: Guarded, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(authentication, "_UNKNOWN", 1000.0)
    text, key = guarded.catalogue.make_key("eve", ["jobs:read"], "", None)
    strange = f"jp_{int(key.id, 16) ^ 1:08x}_{'A' * 43}"
    looked_up, plain = [], Catalogue.key

    def key_of(catalogue: Catalogue, name: str) -> Key:
        looked_up.append(name)
        return plain(catalogue, name)

    monkeypatch.setattr(Catalogue, "key", key_of)
    for bearer, status in ((strange, 401), (strange, 401), (text, 200), (strange, 401)):
        headers = {"Authorization": f"Bearer {bearer}"}
        answer = httpx.get(f"{guarded.url}/v1/jobs", headers=headers, trust_env=False)
        assert answer.status_code == status
    assert looked_up == [strange.split("_")[1], key.id]


def test_a_stream_ends_when_its_key_is_revoked(
    guarded: Guarded, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(authentication, "_REMEMBERED", 0.0)
    monkeypatch.setattr(events, "_QUIET", 0.1)
    with guarded.as_("ada") as http:
        waiting = http.post("/v1/jobs", json=SWING | {"duration": 3.0}).json()["id"]
        with http.stream("GET", f"/v1/jobs/{waiting}/events", timeout=60) as stream:
            lines = stream.iter_lines()
            next(line for line in lines if "queued" in line)
            guarded.catalogue.revoke_key(http.headers["Authorization"].split("_")[1])
            assert all("running" not in line for line in lines)
        assert guarded.catalogue.get(waiting).state == "queued"


def test_clients_send_it(guarded: Guarded) -> None:
    key = guarded.key("ada")
    with Client(guarded.url, key=key) as client:
        job = client.job(guarded.job)
        headers = {"Authorization": f"Bearer {key}"}
        address = f"{guarded.url}/v1/jobs/{guarded.job}/zarr"
        stored = xarray.open_zarr(address, storage_options={"headers": headers})
        np.testing.assert_array_equal(stored["slider7.x"], job.window("slider7.x")["slider7.x"])
        answer = httpx.get(f"{address}/zarr.json", headers=headers, trust_env=False)
        assert answer.headers["Cache-Control"].startswith("private")
    with Client(guarded.url) as client, pytest.raises(ClientError, match="key"):
        client.job(guarded.job)


def test_where_keys_are_required_the_first_sentence_says_so(tmp_path: Path) -> None:
    command = [sys.executable, "-P", "-m", "jointplay.service.processes.api"]
    environment = os.environ | {"JOINTPLAY_DATA": str(tmp_path), "JOINTPLAY_KEYS": "required"}
    ended = subprocess.run(command, capture_output=True, text=True, env=environment, check=False)
    assert ended.returncode == 1
    assert ended.stderr.startswith("nobody has a key, and keys are required: make one with")


@pytest.mark.parametrize("in_postgresql", [False, True])
def test_a_service_that_nobody_has_a_key_to_says_how_one_is_made(
    tmp_path: Path, *, in_postgresql: bool
) -> None:
    started = [sys.executable, "-P", "-m", "jointplay.service.processes.api", "--host", "0.0.0.0"]
    environment = os.environ | {"JOINTPLAY_DATA": str(tmp_path), "JOINTPLAY_LOG_FORMAT": "json"}
    with ExitStack() as stack:
        if in_postgresql:
            environment["JOINTPLAY_CATALOGUE_URL"] = stack.enter_context(running_server()).new()
        ended = subprocess.run(started, capture_output=True, text=True, env=environment)
    assert ended.returncode == 1
    (line,) = ended.stderr.splitlines()
    assert line.startswith("nobody has a key, and others can reach 0.0.0.0: make one with")
    assert ("--data" in line) != in_postgresql
