"""Attacks by one owner on the others."""

import json
import time
from collections import Counter, deque
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack

from benchmarks.single_attacks.attacked import SWING, Attacked
from tests.solver.random_mechanisms import chain

_PATIENCE = 45.0  # s


def batches(service: Attacked) -> str:
    """Have one owner send twelve slow batches, and another one a simple one."""
    scene = chain(20).model_dump(mode="json")
    slow = [SWING | {"scene": scene, "duration": 1.0 + number} for number in range(1200)]
    body = json.dumps({"jobs": slow}).encode()
    head = {"Content-Type": "application/json"}
    simple = json.dumps({"jobs": [SWING | {"duration": 1.0 + n} for n in range(500)]})
    with ExitStack() as stack:
        for _ in range(12):
            sent = service.head("POST /v1/batches", "ada", len(body)) + body
            service.connected(stack, sent)
        time.sleep(3.0)
        statuses: Counter[int] = Counter()
        begun = time.monotonic()
        with service.as_("bob") as bob:
            while not statuses[202] and time.monotonic() - begun < _PATIENCE:
                status = bob.post("/v1/batches", content=simple, headers=head).status_code
                statuses[status] += 1
                time.sleep(0.0 if status == 202 else 1.0)
        took = time.monotonic() - begun
    told = ", ".join(f"{count} times {status}" for status, count in statuses.items() if count)
    return f"{told} in {took:.0f} s"


def streams(service: Attacked) -> str:
    """Have one owner take 262 streams of events, and others come."""
    with service.as_("ada") as ada:
        job = ada.post("/v1/jobs", json=SWING).raise_for_status().json()["id"]
    asked = service.head(f"GET /v1/jobs/{job}/events", "ada")
    with ExitStack() as stack:
        for _ in range(262):
            service.connected(stack, asked).recv(13)  # each is answered before the next one comes
        statuses = []
        for _ in range(5):
            with service.as_("bob") as bob:
                statuses.append(bob.get("/v1/jobs").status_code)
    return f"another's requests {', '.join(map(str, statuses))}"


def rates(service: Attacked) -> str:
    """Ask as fast as possible, where an owner has 20 requests a second, 200 in ten."""
    until = time.monotonic() + 14.0

    def ask(_: int) -> list[float]:
        accepted = []
        with service.as_("ada") as ada:
            while time.monotonic() < until:
                at = time.monotonic()
                if ada.get("/v1/jobs").status_code == 200:
                    accepted.append(at)
        return accepted

    with ThreadPoolExecutor(4) as threads:
        accepted = sorted(at for found in threads.map(ask, range(4)) for at in found)
    window: deque[float] = deque()
    most = 0
    for at in accepted:
        window.append(at)
        while at - window[0] > 10.0:
            window.popleft()
        most = max(most, len(window))
    return f"at most {most} in 10 s"
