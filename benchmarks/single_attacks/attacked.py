"""A service that is attacked, of this program or of an earlier one."""

import os
import socket
import subprocess
import sys
from base64 import b64encode
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager
from hashlib import sha256
from pathlib import Path
from typing import Any, NamedTuple
from urllib.parse import urlsplit

import httpx

from benchmarks.joined import joined_worker
from benchmarks.memory import anonymous
from jointplay.chaos.inside import FOLDER_VARIABLE
from jointplay.chaos.processes import running
from jointplay.service.processes import running_service
from tests.backends import backends

OWNERS = {
    "ada": ("jobs:write", "jobs:read", "results:read"),
    "bob": ("jobs:write", "jobs:read", "results:read"),
    "lab": ("worker",),
}
VARIABLES = {
    "JOINTPLAY_KEYS": "required",
    "JOINTPLAY_LEASE": "6",
    "JOINTPLAY_HEARTBEAT": "1",
    "JOINTPLAY_REAPER_PERIOD": "0.2",
}
_SOLVER = (
    "from importlib.metadata import version; from jointplay.worker.own_solver import own_solver;"
    "own = own_solver(); print(version('jointplay'), own.version, own.processor)"
)
SWING: dict[str, Any] = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 2.0}


class Held(NamedTuple):
    """A block that was claimed."""

    path: str
    job: str
    number: int

    def rows(self, number: int) -> str:
        """Return the name of a file of its attempt."""
        return f"a{self.path.rpartition('/')[2]}/rows/{number}"


class Attacked(NamedTuple):
    """A service and its keys."""

    url: str
    keys: Mapping[str, str]
    folder: Path
    variables: Mapping[str, str]

    @property
    def address(self) -> tuple[str, int]:
        """Where it listens."""
        parts = urlsplit(self.url)
        return str(parts.hostname), int(parts.port or 80)

    def as_(self, owner: str = "") -> httpx.Client:
        """Return a client of an owner, or of one without a key, that waits for 60 s at most."""
        head = {"Authorization": f"Bearer {self.keys[owner]}"} if owner in self.keys else {}
        return httpx.Client(base_url=self.url, headers=head, trust_env=False, timeout=60.0)

    def head(self, asked: str, owner: str = "", length: int | None = None) -> bytes:
        """Return the head of a request; without the empty line at its end if there is a length."""
        key = f"Authorization: Bearer {self.keys[owner]}\r\n" if owner else ""
        told = f"Content-Type: application/json\r\nContent-Length: {length}\r\n"
        return f"{asked} HTTP/1.1\r\nHost: 127.0.0.1\r\n{key}{told if length else ''}\r\n".encode()

    def connected(self, stack: ExitStack, sent: bytes = b"", room: int = 0) -> socket.socket:
        """Return a connection that has sent something; with little room it takes no answer."""
        one = stack.enter_context(socket.socket())
        if room:
            one.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, room)
        one.settimeout(60.0)
        one.connect(self.address)
        one.sendall(sent)
        return one

    def submit(self, document: dict[str, Any]) -> str:
        """Submit a job that is computed anew, and return its id."""
        with self.as_("bob") as bob:
            answer = bob.post("/v1/jobs", json=document | {"cache": False})
            return str(answer.raise_for_status().json()["id"])

    def ended(self, job: str) -> dict[str, Any]:
        """Return a job once it has ended."""
        found: dict[str, Any] = {"finished": None}
        with self.as_("bob") as bob:
            while found["finished"] is None:
                found = bob.get(f"/v1/jobs/{job}", params={"wait": 5}).raise_for_status().json()
        return found

    def occurrences(self, job: str, happened: str) -> int:
        """Return how often something has happened to a job."""
        found = 0
        with self.as_("bob") as bob, bob.stream("GET", f"/v1/jobs/{job}/events") as events:
            for line in events.iter_lines():
                if line == "event: progress":  # of now; what comes after is yet to happen
                    break
                found += line == f"event: {happened}"
        return found

    def claim(self, number: int = 1) -> Held:
        """Claim a block as a worker that joined."""
        asked = [sys.executable, "-P", "-c", _SOLVER]
        found = subprocess.run(asked, env=self.environment, capture_output=True, check=True)
        program, version, processor = found.stdout.decode().split()
        document = {
            "program": program,
            "worker": f"machine:{number}:1:machine",
            "version": version,
            "processor": processor,
            "wait": 20.0,
        }
        with self.as_("lab") as lab:
            answer = lab.post("/v1/worker/claims", json=document).raise_for_status()
        block = answer.json()["claim"]["block"]
        path = f"/v1/worker/blocks/{block['id']}/{block['attempt']}"
        return Held(path, block["job"], block["index"])

    def put(self, held: Held, name: str, content: bytes) -> int:
        """Return the status with which a file of a block is taken."""
        told = f"sha-256=:{b64encode(sha256(content).digest()).decode()}:"
        with self.as_("lab") as lab:
            path = f"{held.path}/files/{name}"
            return lab.put(path, content=content, headers={"Content-Digest": told}).status_code

    @property
    def environment(self) -> dict[str, str]:
        """Variables of programs of its version on its machine."""
        return os.environ | dict(self.variables) | {"JOINTPLAY_DATA": str(self.folder / "data")}

    @contextmanager
    def joined(self) -> Iterator[None]:
        """Keep a worker running that has joined."""
        own = self.environment
        if "lab" in self.keys:
            own["JOINTPLAY_KEY"] = self.keys["lab"]
        with joined_worker(self.url, own):
            yield

    def memory(self) -> float:
        """Return the memory of its API, MB."""
        return sum(anonymous(one.pid) for one in running(self.folder, "api"))


@contextmanager
def attacked(
    kind: str, folder: Path, program: Path | None, own: Mapping[str, str]
) -> Iterator[Attacked]:
    """Serve in a folder, by an earlier program if one is installed somewhere, without a worker."""
    with backends(kind) as variables:
        variables |= VARIABLES | {FOLDER_VARIABLE: str(folder)} | dict(own)
        if program is not None:
            variables["PYTHONPATH"] = str(program)
        data = folder / "data"
        data.mkdir(exist_ok=True)
        keys = {}
        for owner, scopes in OWNERS.items() if variables["JOINTPLAY_KEYS"] != "none" else ():
            command = [sys.executable, "-P", "-m", "jointplay", "key", "new", "--owner", owner]
            command += [f"--scope={scope}" for scope in scopes]
            made = subprocess.run(
                [*command, "--data", str(data)],
                env=os.environ | variables,
                capture_output=True,
                text=True,
                check=True,
            )
            keys[owner] = made.stdout.split()[-1]
        with running_service(data, 0, variables) as url:
            yield Attacked(url, keys, folder, variables)
