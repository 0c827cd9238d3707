"""Attacks by connections and what is sent over them, most of them without a key."""

import time
from contextlib import ExitStack

from benchmarks.single_attacks.attacked import SWING, Attacked

_LEASE = 6.0  # s
_LONG = {
    "kind": "simulate",
    "scene": {"preset": "seven-bar-press", "parameters": {"clearance": 5e-4, "friction": 0.1}},
    "duration": 300.0,
    "channels": ["slider7.x"],
    "certificate": False,
}


def _healthy(service: Attacked) -> int:
    """Return how many of five new connections are told that all is well."""
    found = 0
    for _ in range(5):
        with service.as_() as anyone:
            found += anyone.get("/healthz").status_code == 200
    return found


def idle(service: Attacked) -> str:
    """Hold 270 idle connections for longer than a lease, three times, as a worker computes."""
    healthy, job = 0, service.submit(_LONG)
    with service.joined():
        for claims in range(1, 4):
            _await_claim(service, job, claims)
            with ExitStack() as stack:
                for _ in range(270):
                    service.connected(stack)
                healthy += _healthy(service)
                time.sleep(1.5 * _LEASE)
        ended = service.ended(job)
    problem = (ended["error"] or {}).get("code", "")
    told = f"`/healthz` {healthy} of 15; of the joined worker {service.occurrences(job, 'lost')}"
    return f"{told} attempts lost, job {ended['state']} {problem}".strip()


def _await_claim(service: Attacked, job: str, claims: int) -> None:
    """Wait for so many claims of a job, for some seconds: where none was lost there is one."""
    until = time.monotonic() + (10.0 if claims > 1 else 60.0)
    while service.occurrences(job, "claimed") < claims and time.monotonic() < until:
        time.sleep(0.5)
    time.sleep(1.0)


def bodies(service: Attacked) -> str:
    """Send 40 batches of 33 MB but for their ends."""
    body = service.head("POST /v1/batches", "ada", 33_000_000) + b"[" + b" " * 32_900_000
    before = most = service.memory()
    with ExitStack() as stack:
        for _ in range(40):
            one = service.connected(stack)
            try:
                one.sendall(body)
            except OSError:  # refused, and closed
                continue
            most = max(most, service.memory())
        for _ in range(20):
            most = max(most, service.memory())
            time.sleep(0.1)
    return f"API {before:.0f} → {most:.0f} MB"


def refusals(service: Attacked) -> str:
    """Ask for more at once than is answered, and look at the refusal."""
    asked = 20 * service.head("GET /openapi.json")
    with ExitStack() as stack:
        for _ in range(260):
            service.connected(stack, asked, room=4096)
        time.sleep(2.0)
        with service.as_() as anyone:
            refused, health = anyone.get("/openapi.json"), anyone.get("/healthz")
    kind = refused.headers.get("content-type", "").partition(";")[0]
    again = refused.headers.get("retry-after", "none")
    told = f"{refused.status_code}, `{kind}`, Retry-After {again}"
    return f"{told}; `/healthz` {health.status_code}"


def browsers(service: Attacked) -> str:
    """Look at the head of a figure, and send a name of a host that only begins as an address."""
    job = service.submit(SWING)
    with service.joined():
        service.ended(job)
    with service.as_("bob") as bob:
        figure = bob.get(f"/v1/jobs/{job}/figures/energy.svg")
        policy = {"x-content-type-options", "content-security-policy"} & figure.headers.keys()
        foreign = bob.get("/v1/jobs", headers={"Host": "[::1].evil.example"})
    return f"SVG {figure.status_code} with {len(policy)} of 2 headers; Host {foreign.status_code}"
