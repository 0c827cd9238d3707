"""Two APIs over one PostgreSQL: what is sent to both at once is made once."""

import os
import socket
import subprocess
import sys
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, contextmanager
from pathlib import Path

import httpx
import pytest

from jointplay.storage.catalogue.catalogue import Catalogue
from tests.postgresql_server import running_server

JOB = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 1.0}
TIMES = 1000


@contextmanager
def api(environment: dict[str, str]) -> Iterator[str]:
    with socket.create_server(("127.0.0.1", 0), backlog=256) as listening:
        command = [sys.executable, "-m", "jointplay.service.processes.api", "--fd"]
        process = subprocess.Popen(
            [*command, str(listening.fileno())],
            env=os.environ | environment,
            pass_fds=[listening.fileno()],
            stderr=subprocess.DEVNULL,
        )
        try:
            yield f"http://127.0.0.1:{listening.getsockname()[1]}"
        finally:
            process.kill()
            process.wait()


@pytest.mark.long
@pytest.mark.parametrize("how", ["one key", "one job"])
def test_one_request_sent_a_thousand_times_makes_one_job(tmp_path: Path, how: str) -> None:
    headers = {"Idempotency-Key": "the-same"} if how == "one key" else {}
    document = JOB | {"cache": how == "one job"}
    with running_server() as server, ExitStack() as stack:
        url = server.new("template0")
        environment = {"JOINTPLAY_CATALOGUE_URL": url, "JOINTPLAY_DATA": str(tmp_path)}
        apis = [stack.enter_context(api(environment)) for _ in range(2)]
        clients = [
            stack.enter_context(httpx.Client(base_url=one, trust_env=False, timeout=300))
            for one in apis
        ]
        for http in clients:  # the socket listens already: it is answered when it is up
            assert http.get("/readyz").status_code == 200

        def send(number: int) -> tuple[int, str | None]:
            answer = clients[number % 2].post("/v1/jobs", json=document, headers=headers)
            return answer.status_code, answer.json().get("id")

        with ThreadPoolExecutor(32) as threads:
            found = list(threads.map(send, range(TIMES)))
        catalogue = Catalogue(url)
        (job,) = catalogue.jobs().jobs
        catalogue.close()
    # of one key an API answers one request at a time; the client sends the others again
    assert set(Counter(status for status, _ in found)) <= {200, 202, 409}
    assert {made for status, made in found if status != 409} == {job.id}
