"""A service that is attacked: health, accepted jobs a second, and memory of the API.

    python -m benchmarks attack

1000 sockets that say nothing, 500 heads of requests that never end and 200 clients that take
nothing of their answers, all without a key, and 100 bodies of 33 MB that never end, of an owner who
has one. What the service closes is opened again, every five seconds. Another owner submits, as in
`submission`, and a worker that joined computes what a third one has submitted, before the attack
and while it lasts.
"""

import asyncio
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import ExitStack, closing, contextmanager
from pathlib import Path
from typing import Any, Final, NamedTuple

import httpx

from benchmarks.memory import anonymous
from benchmarks.submission import at_full_speed, different
from jointplay.chaos.held_connections import HALF_A_HEAD, MANY_ANSWERS, NOTHING, HeldConnections
from jointplay.chaos.inside import FOLDER_VARIABLE
from jointplay.chaos.processes import running
from jointplay.service.processes import running_service
from jointplay.storage.catalogue.catalogue import Catalogue
from tests.backends import backends, settings_at

KINDS: Final = ("folder", "bucket")
"""SQLite and a folder; PostgreSQL and a bucket."""
OWNERS: Final = {
    "ada": ["jobs:write"],
    "bob": ["jobs:write", "jobs:read"],
    "eve": ["jobs:write"],
    "lab": ["worker"],
}
IDLE, HALF, READERS, BODIES = 1000, 500, 200, 100
_BODY: Final = (
    "POST /v1/batches HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Type: application/json\r\n"
    "Authorization: Bearer {key}\r\nContent-Length: 33000000\r\n\r\n["
)
_SWING: Final[dict[str, Any]] = {"kind": "simulate", "scene": {"preset": "pendulum"}}


class Attacked(NamedTuple):
    """A service, and who has a key."""

    url: str
    keys: dict[str, str]
    api: int

    def as_(self, owner: str) -> httpx.Client:
        """Return a client of an owner."""
        head = {"Authorization": f"Bearer {self.keys[owner]}"}
        return httpx.Client(base_url=self.url, headers=head, trust_env=False, timeout=60.0)


class Attack(HeldConnections):
    """Holds connections, and looks how much memory the API takes."""

    def __init__(self, attacked: Attacked) -> None:
        body = _BODY.format(key=attacked.keys["eve"]).encode() + b" " * 4_000_000
        sent = [NOTHING] * IDLE + [HALF_A_HEAD] * HALF + [MANY_ANSWERS] * READERS + [body] * BODIES
        super().__init__(attacked.url, sent)
        self._api, self.largest = attacked.api, 0.0

    def look(self) -> None:
        """Remember the most memory."""
        self.largest = max(self.largest, anonymous(self._api))


@contextmanager
def service(kind: str, folder: Path) -> Iterator[Attacked]:
    """Run a service that requires keys, and a worker that joined it."""
    with ExitStack() as stack:
        variables = {"JOINTPLAY_KEYS": "required", FOLDER_VARIABLE: str(folder)}
        variables |= stack.enter_context(backends(kind))
        data = folder / "data"
        data.mkdir()
        with closing(Catalogue(settings_at(data, variables).catalogue_url)) as catalogue:
            catalogue.migrate()
            keys = {one: catalogue.make_key(one, OWNERS[one], "", None)[0] for one in OWNERS}
        url = stack.enter_context(running_service(data, 0, variables))
        (api,) = running(folder, "api")
        command = [sys.executable, "-P", "-m", "jointplay", "worker", "--join", url]
        worker = subprocess.Popen(
            command, env=os.environ | {"JOINTPLAY_KEY": keys["lab"]}, stderr=subprocess.DEVNULL
        )
        stack.callback(worker.wait)
        stack.callback(worker.terminate)
        yield Attacked(url, keys, api.pid)


def health(attacked: Attacked) -> list[tuple[int, float]]:
    """Return status and seconds of five probes, each with a connection of its own."""
    found = []
    for _ in range(5):
        begun = time.perf_counter()
        status = httpx.get(f"{attacked.url}/healthz", trust_env=False, timeout=60.0).status_code
        found.append((status, time.perf_counter() - begun))
    return found


def submit(attacked: Attacked, first: int, count: int = 10) -> list[str]:
    """Submit small jobs that differ, and return their ids."""
    with attacked.as_("bob") as bob:
        jobs = [_SWING | {"duration": 1.0 + 1e-3 * (first + number)} for number in range(count)]
        return [bob.post("/v1/jobs", json=job).raise_for_status().json()["id"] for job in jobs]


def states(attacked: Attacked, jobs: list[str]) -> list[str]:
    """Return in which states jobs have ended, once they have."""
    found = []
    with attacked.as_("bob") as bob:
        for one in jobs:
            job: dict[str, Any] = {"finished": None}
            while job["finished"] is None:
                job = bob.get(f"/v1/jobs/{one}", params={"wait": 20}).raise_for_status().json()
            found.append(str(job["state"]))
    return found


def main() -> None:
    """Print what both kinds of service do before an attack and while it lasts."""
    for kind in KINDS:
        with tempfile.TemporaryDirectory() as made, service(kind, Path(made)) as attacked:
            states(attacked, submit(attacked, 0))  # kernels are compiled
            number = 1
            for _ in range(2):  # the first rate is that of a start
                rate, number = asyncio.run(
                    at_full_speed(attacked.url, different, number, attacked.keys["ada"])
                )
            before = anonymous(attacked.api)
            with Attack(attacked) as attack:
                jobs = submit(attacked, 100)
                probes = health(attacked)
                under, _ = asyncio.run(
                    at_full_speed(attacked.url, different, number, attacked.keys["ada"])
                )
                probes += health(attacked)
                ended = states(attacked, jobs)
            print(f"{kind}; load of the machine {os.getloadavg()[0]:.1f}")
            print(f"  submissions a second        {rate:.0f} before, {under:.0f} under attack")
            print(f"  health answered with 200    {[s for s, _ in probes].count(200)} of 10")
            print(f"  seconds of a probe          {max(s for _, s in probes):.2f} at most")
            print(f"  MB of the API               {before:.0f} before, {attack.largest:.0f} then")
            print(f"  connections opened again    {attack.again}")
            print(f"  jobs of the joined worker   {ended.count('succeeded')} of {len(ended)}")


if __name__ == "__main__":
    main()
