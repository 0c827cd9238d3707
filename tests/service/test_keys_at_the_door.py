"""A service that asks for keys: who may do what, and that others' jobs are not there."""

import json
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

import httpx
import numpy as np
import pytest
import xarray

from jointplay.client import Client, ClientError
from jointplay.service.access import door
from jointplay.service.access.signed import Link
from jointplay.service.app import create_app
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.keys import Key
from jointplay.storage.settings import Settings
from tests.service_in_thread import Worker, serving

SWING = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 1.0}
USUAL = ["jobs:write", "jobs:read", "results:read"]
OPEN = ("/healthz", "/readyz", "/v1/scenes", "/v1/laws", "/v1/schemas", "/problems")
IDS = {
    "job_id": "",
    "batch_id": "",
    "key": "zarr.json",
    "name": "orbit",
    "form": "svg",
    "scene": "press",
}


@dataclass
class Guarded:
    """The service, and what one owner has there."""

    url: str
    catalogue: Catalogue
    job: str
    batch: str

    def key(self, owner: str, *scopes: str) -> str:
        return self.catalogue.make_key(owner, scopes or USUAL, "", None)[0]

    def as_(self, owner: str, *scopes: str) -> httpx.Client:
        headers = {"Authorization": f"Bearer {self.key(owner, *scopes)}"}
        return httpx.Client(base_url=self.url, headers=headers, trust_env=False, timeout=60)

    def path(self, template: str, **names: str) -> str:
        known = IDS | {"job_id": self.job, "batch_id": self.batch} | names
        return template.format(**known)

    def operations(self) -> Iterator[tuple[str, str]]:
        document = httpx.get(f"{self.url}/openapi.json", trust_env=False).json()
        for template, operations in document["paths"].items():
            yield from ((method.upper(), template) for method in operations)


@pytest.fixture(scope="module")
def guarded(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Guarded]:
    settings = Settings(data=tmp_path_factory.mktemp("data"), keys="required")
    with serving(create_app(settings)) as url:
        catalogue = Catalogue(settings.catalogue_url)
        catalogue.migrate()
        found = Guarded(url, catalogue, "", "")
        with found.as_("ada") as http:
            worker = Worker(http, catalogue, settings)
            found.job = worker.finished()
            found.batch = http.post("/v1/batches", json={"jobs": [SWING]}).json()["id"]
        yield found
        catalogue.close()


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
    monkeypatch.setattr(door, "_REMEMBERED", 0.0)
    with guarded.as_("ada") as http:
        assert http.get("/v1/jobs").status_code == 200
        used = [key for key in guarded.catalogue.all_keys() if key.last_used is not None]
        name = http.headers["Authorization"].split("_")[1]
        assert name in {key.id for key in used}
        guarded.catalogue.revoke_key(name)
        assert http.get("/v1/jobs").status_code == 401


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


def test_a_signed_link_opens_the_arrays_of_its_job_to_stock_clients(guarded: Guarded) -> None:
    with guarded.as_("ada") as ada:
        made = ada.post(f"/v1/jobs/{guarded.job}/links", params={"seconds": 3600})
        assert made.status_code == 201
        address = f"{guarded.url}{made.json()['zarr']}"
        history = ada.get(f"/v1/jobs/{guarded.job}/history", params={"channels": "slider7.x"})
        assert ada.post(f"/v1/jobs/{guarded.job}/links", params={"seconds": 0}).status_code == 422
    stored = xarray.open_zarr(address)
    assert stored["slider7.x"].size == len(history.json()["time"]["values"])
    get = partial(httpx.get, trust_env=False)
    part = get(f"{address}/zarr.json", headers={"Range": "bytes=0-9"})
    assert (part.status_code, len(part.content)) == (206, 10)
    assert part.headers["Cache-Control"].startswith("private")
    assert httpx.post(f"{address}/zarr.json", trust_env=False).status_code == 405
    for other in ("", "/peaks", "/zarr/../peaks", "/zarr/%2e%2e/peaks", "/links"):
        answer = get(f"{address.removesuffix('/zarr')}{other}")
        assert answer.status_code == 404, other


def test_a_link_lasts_for_its_time_and_as_long_as_its_key(
    guarded: Guarded, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(door, "_REMEMBERED", 0.0)
    text = guarded.key("ada")
    key = guarded.catalogue.key(text.split("_")[1])
    now = int(guarded.catalogue.clock())

    def opened(link: Link, signer: Key) -> int:
        address = f"{guarded.url}/v1/shared/{link.signed_by(signer)}/zarr/zarr.json"
        return httpx.get(address, trust_env=False).status_code

    good = Link(guarded.job, now + 100, key.id)
    assert opened(good, key) == 200
    assert opened(replace(good, until=now - 1), key) == 401
    assert opened(replace(good, key="00000000"), key) == 401
    forger = replace(key, sha256="0" * 64)
    assert opened(good, forger) == 401
    others = guarded.catalogue.key(guarded.key("bob").split("_")[1])
    assert opened(replace(good, key=others.id), others) == 404  # not his job
    unread = guarded.catalogue.key(guarded.key("ada", "jobs:read").split("_")[1])
    assert opened(replace(good, key=unread.id), unread) == 403
    guarded.catalogue.revoke_key(key.id)
    assert opened(good, key) == 401


@pytest.mark.parametrize("token", ["", "x", "A" * 103, "A" * 99, "é", "A" * 5000, "%00"])
def test_what_is_no_token_leads_nowhere(guarded: Guarded, token: str) -> None:
    address = f"{guarded.url}/v1/shared/{token}/zarr/zarr.json"
    assert httpx.get(address, trust_env=False).status_code == 404


def test_whoever_asks_too_often_is_told_when_to_come_back(tmp_path: Path) -> None:
    settings = Settings(data=tmp_path, keys="required", rate=0.5)
    catalogue = Catalogue(settings.catalogue_url)
    catalogue.migrate()
    with serving(create_app(settings)) as url:
        guarded = Guarded(url, catalogue, "", "")
        with guarded.as_("ada") as ada, guarded.as_("bob") as bob:
            answers = [ada.get("/v1/jobs") for _ in range(12)]  # two windows at most
            refused = [answer for answer in answers if answer.status_code == 429]
            assert len(refused) >= 2
            assert 1 <= int(refused[0].headers["Retry-After"]) <= 10
            assert "more than 5 requests in 10 s" in refused[0].json()["detail"]
            assert bob.get("/v1/jobs").status_code == 200
    catalogue.close()


def test_an_owner_has_so_many_jobs_at_a_time(tmp_path: Path) -> None:
    settings = Settings(data=tmp_path, keys="required", most_live=3)
    catalogue = Catalogue(settings.catalogue_url)
    catalogue.migrate()
    with serving(create_app(settings)) as url:
        guarded = Guarded(url, catalogue, "", "")
        with guarded.as_("ada") as ada, guarded.as_("root", "admin") as root:
            batch = {"jobs": [SWING, SWING]}
            assert ada.post("/v1/batches", json=batch).status_code == 202
            refused = ada.post("/v1/batches", json=batch)
            assert refused.status_code == 403
            assert refused.json()["type"] == "/problems/quota-exceeded"
            assert "has 2 jobs that have not ended, and may have 3" in refused.json()["detail"]
            again = {"Idempotency-Key": "again"}
            last, same = (
                ada.post("/v1/jobs", json=SWING | {"cache": False}, headers=again) for _ in "ab"
            )
            assert (last.status_code, same.status_code) == (202, 202)
            assert same.json()["id"] == last.json()["id"]
            assert ada.post("/v1/jobs", json=SWING | {"cache": False}).status_code == 403
            assert root.post("/v1/batches", json=batch).status_code == 202
            ada.post(f"/v1/jobs/{last.json()['id']}/cancel")
            assert ada.post("/v1/jobs", json=SWING | {"cache": False}).status_code == 202
    catalogue.close()


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
        ({"Origin": "http://localhost:3000"}, 200),
        ({"Origin": "https://lab.example"}, 200),
        ({"Host": "192.168.1.7:8000", "Origin": "http://192.168.1.7:8000"}, 200),
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
