"""The API killed while it accepts jobs: what it answered with 202 is there, and whole."""

import os
import socket
import subprocess
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager

import httpx

from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.settings import Settings
from tests.waiting import until

CLIENTS = 8
ENOUGH = 200  # jobs answered before the kill


@contextmanager
def api(settings: Settings) -> Iterator[tuple[str, subprocess.Popen[bytes]]]:
    with socket.create_server(("127.0.0.1", 0)) as listening:
        url = f"http://127.0.0.1:{listening.getsockname()[1]}"
        command = [
            sys.executable,
            "-m",
            "jointplay.service.processes.api",
            "--fd",
            str(listening.fileno()),
        ]
        process = subprocess.Popen(
            command,
            env=os.environ | {"JOINTPLAY_DATA": str(settings.data)},
            pass_fds=[listening.fileno()],
            stderr=subprocess.DEVNULL,
        )
    try:
        yield url, process  # nobody else holds the socket: when it is killed clients notice
    finally:
        process.kill()
        process.wait()


def test_accepted_jobs_outlive_the_process_that_accepted_them(
    settings: Settings, catalogue: Catalogue
) -> None:
    answered: list[str] = []
    enough = threading.Event()

    def submit(url: str, client: int) -> None:
        with httpx.Client(base_url=url, trust_env=False, timeout=60.0) as http:
            number = 0
            while True:
                number += 1
                parameters = {"clearance": 1e-4 + 1e-9 * (CLIENTS * number + client)}
                scene = {"preset": "slider-crank", "parameters": parameters}
                job = {"kind": "simulate", "scene": scene, "duration": 1.0}
                try:
                    answer = http.post("/v1/jobs", json=job)
                except httpx.TransportError:
                    return  # killed
                assert answer.status_code == 202
                answered.append(answer.json()["id"])
                if len(answered) >= ENOUGH:
                    enough.set()

    with api(settings) as (url, process):
        threads = [threading.Thread(target=submit, args=(url, k)) for k in range(CLIENTS)]
        for thread in threads:
            thread.start()
        until(enough.is_set, progress=lambda: len(answered))
        process.kill()
        for thread in threads:
            thread.join()
    assert len(set(answered)) == len(answered) >= ENOUGH
    waiting = {wake_up.block for wake_up in catalogue.due_wake_ups(100_000)}
    for job in answered:
        assert catalogue.get(job).id == job
        assert {block.id for block in catalogue.blocks(job)} <= waiting
        assert [event.type for event in catalogue.events(job)] == ["queued"]
