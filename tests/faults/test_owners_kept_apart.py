"""Slow checks, streams, waiting requests and large bodies of one owner keep no other out."""

import json
import select
import socket
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, contextmanager
from importlib.metadata import version
from pathlib import Path
from typing import NamedTuple

import httpx
import pytest
from jobs import catalogue_of

from jointplay.service.checking import SHORT
from jointplay.service.processes import running_service
from tests.backends import BACKENDS, backends, settings_at
from tests.solver.random_mechanisms import chain
from tests.waiting import PATIENCE, until

SWING = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 1.0}
SLOW = SWING | {"scene": chain(20).model_dump(mode="json")}
SCOPES = ["jobs:write", "jobs:read", "worker"]


class Keyed(NamedTuple):
    url: httpx.URL
    keys: dict[str, str]

    @contextmanager
    def as_(self, owner: str) -> Iterator[httpx.Client]:
        headers = {"Authorization": f"Bearer {self.keys[owner]}"}
        limits = httpx.Limits(max_connections=None)
        with httpx.Client(
            base_url=self.url, headers=headers, trust_env=False, timeout=None, limits=limits
        ) as client:
            yield client

    def head(self, owner: str, asked: str) -> bytes:
        key = f"Authorization: Bearer {self.keys[owner]}"
        return f"{asked} HTTP/1.1\r\nHost: {self.url.host}\r\n{key}\r\n".encode()


@pytest.fixture(scope="module", params=BACKENDS)
def keyed(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[Keyed]:
    data: Path = tmp_path_factory.mktemp("owners") / "data"
    with backends(request.param) as variables:
        with catalogue_of(settings_at(data, variables)) as catalogue:
            keys = {one: catalogue.make_key(one, SCOPES, "", None)[0] for one in ("ada", "bob")}
        with running_service(data, 0, variables | {"JOINTPLAY_KEYS": "required"}) as url:
            yield Keyed(httpx.URL(url), keys)


def answered(one: socket.socket) -> int:
    """Return the status of an answer as soon as it begins."""
    head = b""
    while not head.endswith(b" "):
        head += one.recv(13 - len(head))
    return int(head[9:12])


def test_slow_batches_of_one_owner_wait_for_their_turn(keyed: Keyed) -> None:
    slow = {"jobs": [SLOW | {"duration": 1.0 + number} for number in range(40)]}
    simple = json.dumps({"jobs": [SWING]}).ljust(SHORT + 1)  # checked where the slow ones are
    with keyed.as_("ada") as ada, keyed.as_("bob") as bob, ThreadPoolExecutor(12) as threads:
        sent = [threads.submit(ada.post, "/v1/batches", json=slow) for _ in range(12)]
        until(lambda: sum(one.done() for one in sent) >= 4)  # refused: he has eight there
        for _ in range(3):
            own = bob.post(
                "/v1/batches", content=simple, headers={"Content-Type": "application/json"}
            )
            assert own.status_code == 202
        assert not all(one.done() for one in sent)
        found = Counter(one.result().status_code for one in sent)
    assert found[202] >= 8
    assert found[202] + found[503] == 12


def test_bodies_of_one_owner_that_never_end_leave_room(keyed: Keyed) -> None:
    told = "Content-Type: application/json\r\nContent-Length: 33000000\r\n\r\n"
    body = keyed.head("ada", "POST /v1/batches") + told.encode() + b" " * 8_000_000
    address = (keyed.url.host, keyed.url.port)
    with keyed.as_("bob") as bob, ExitStack() as stack:
        held = []
        for _ in range(20):
            held.append(stack.enter_context(socket.create_connection(address, timeout=PATIENCE)))
            held[-1].sendall(body)
        answers, _, _ = select.select(held, [], [], PATIENCE)
        assert answered(answers[0]) == 503
        own = bob.post(
            "/v1/batches",
            content=json.dumps({"jobs": [SWING]}).ljust(8_000_000),
            headers={"Content-Type": "application/json"},
        )
        assert own.status_code == 202


@pytest.mark.parametrize("asked", ["events", "?wait=60", "claims"])
def test_streams_and_waits_of_one_owner_leave_room(keyed: Keyed, asked: str) -> None:
    with keyed.as_("ada") as ada, keyed.as_("bob") as bob, ExitStack() as stack:
        job = ada.post("/v1/jobs", json=SWING | {"cache": False}).json()["links"]["self"]
        if asked == "claims":
            claim = {"program": version("jointplay"), "worker": "w", "wait": 20.0}
            body = json.dumps(claim | {"version": "none", "processor": "none"}).encode()
            told = f"Content-Type: application/json\r\nContent-Length: {len(body)}\r\n\r\n"
            request = keyed.head("ada", "POST /v1/worker/claims") + told.encode() + body
        else:
            path = f"{job}/events" if asked == "events" else f"{job}{asked}"
            request = keyed.head("ada", f"GET {path}") + b"\r\n"
        held = []
        for _ in range(262):
            address = (keyed.url.host, keyed.url.port)
            one = stack.enter_context(socket.create_connection(address, timeout=PATIENCE))
            one.sendall(request)
            held.append(one)
        refused = held[-1]
        assert answered(refused) == 429
        rest = b""
        while not rest.endswith(b"}"):
            rest += refused.recv(65536)
        assert b"retry-after: 5" in rest.lower()
        assert b"/problems/too-many-requests" in rest
        for _ in range(5):
            with keyed.as_("bob") as new:
                assert new.get("/v1/jobs").status_code == 200
        assert bob.post("/v1/jobs", json=SWING | {"cache": False}).status_code == 202
        own = bob.get("/v1/jobs").json()["jobs"][0]["links"]["self"]
        with bob.stream("GET", f"{own}/events") as stream:
            assert stream.status_code == 200
    with keyed.as_("ada") as ada:  # once they are gone he has room again

        def has_room() -> bool:
            return ada.get(f"{job}?wait=0.01").status_code == 200

        until(has_room)
