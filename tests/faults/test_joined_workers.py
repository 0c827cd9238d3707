"""Workers that have an address and a key alone: their results are those of any other worker."""

import json
import os
import socket
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path

import httpx
import pytest
from jobs import ended, in_mid_block, pid_of

from jointplay.client import Client
from jointplay.local.running import run
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import Job, JobState
from jointplay.storage.object_stores import StoredObject
from jointplay.storage.settings import Settings
from tests.stores import files_of
from tests.waiting import until

# some seconds of computing; more samples than one shard holds
LONG = {
    "kind": "simulate",
    "scene": {"preset": "seven-bar-press", "parameters": {"clearance": 5e-4, "friction": 0.1}},
    "duration": 200.0,
    "output_step": 2e-3,
    "channels": ["slider7.*", "A.*"],
    "certificate": False,
}
PRESS = LONG | {"duration": 4.0}
DIAGRAM = {
    "kind": "bifurcation",
    "scene": {"preset": "seven-bar-press", "parameters": {"friction": 0.1}},
    "parameter": "clearance",
    "values": {"from": 2e-4, "to": 1e-3, "count": 20},
    "settle": 2,
    "record": 4,
}
EAGER = {"JOINTPLAY_KEYS": "required", "JOINTPLAY_PROGRESS_PERIOD": "0.1"}
OWN = ("HOME", "PATH", "OPENBLAS_", "NUMBA_", "JOINTPLAY_CACHE")
"""Variables that say where programs and kernels are, and what arithmetic depends on."""
MEASURED = ("statistics/seconds/",)


Workers = dict[int, subprocess.Popen[str]]
Local = Callable[[dict[str, object]], Path]


class Lab:
    """A service without workers of its own, and keys for it."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.settings = Settings(data=folder / "data")
        self.settings.data.mkdir()
        self.catalogue = Catalogue(self.settings.catalogue_url)
        self.catalogue.migrate()
        self.keys = {
            scope: self.catalogue.make_key("ada", [scope], "", None)[0]
            for scope in ("worker", "admin", "jobs:write")
        }
        with socket.create_server(("127.0.0.1", 0)) as free:
            self.port = free.getsockname()[1]
        self.url = f"http://127.0.0.1:{self.port}"

    def serve(self) -> None:
        command = [sys.executable, "-P", "-m", "jointplay", "serve", "--workers", "0", "--json"]
        command += ["--port", str(self.port), "--data", str(self.settings.data)]
        environment = os.environ | EAGER
        self._service = subprocess.Popen(command, stdout=subprocess.PIPE, env=environment)
        assert self._service.stdout is not None
        assert self._service.stdout.readline()

    def stop(self) -> None:
        with self._service:
            self._service.terminate()

    def worker(self, scope: str = "worker", *options: str) -> subprocess.Popen[str]:
        """Start a worker that knows nothing but the address and a key."""
        key = self.folder / f"{scope.replace(':', '-')}.key"
        key.write_text(f"{self.keys[scope]}\n")
        command = [sys.executable, "-P", "-m", "jointplay", "worker", "--join", self.url]
        return subprocess.Popen(
            [*command, "--key-file", str(key), *options],
            env={name: value for name, value in os.environ.items() if name.startswith(OWN)},
            cwd=self.folder,
            stderr=subprocess.PIPE,
            text=True,
        )

    def submit(self, document: dict[str, object]) -> str:
        with Client(self.url, key=self.keys["admin"]) as client:
            return client.submit(document | {"cache": False}).id

    def sealed(self, job: Job) -> StoredObject:
        if job.kind == "simulate":
            return self.settings.sealed_run(job.id, job.attempt)
        return self.settings.sealed_study(job.id)


@pytest.fixture(scope="module")
def lab(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Lab]:
    lab = Lab(tmp_path_factory.mktemp("lab"))
    lab.serve()
    yield lab
    lab.stop()
    lab.catalogue.close()


@pytest.fixture(scope="module")
def workers(lab: Lab) -> Iterator[Workers]:
    """Two workers by their process ids; a test that ends one takes it out."""
    with ExitStack() as stack:
        found = {}
        for _ in range(2):
            worker = stack.enter_context(lab.worker())
            stack.callback(worker.kill)
            found[worker.pid] = worker
        yield found


@pytest.fixture(scope="module")
def local(tmp_path_factory: pytest.TempPathFactory) -> Local:
    """Results of a run without a service, by its document."""
    known: dict[str, Path] = {}

    def found(document: dict[str, object]) -> Path:
        name = json.dumps(document)
        if name not in known:
            folder = tmp_path_factory.mktemp("local") / "run"
            run(document, output=folder, processes=1)  # this one: others would have to start
            known[name] = folder / "results.zarr.zip"
        return known[name]

    return found


def assert_same_bits(stored: StoredObject, expected: Path) -> None:
    ours, theirs = files_of(stored), files_of(expected)
    chunks = [key for key in theirs if "/c/" in key and not key.startswith(MEASURED)]
    assert len(chunks) > 20
    assert [key for key in chunks if ours.get(key) != theirs[key]] == []


def test_results_are_those_of_a_local_run(lab: Lab, workers: Workers, local: Local) -> None:
    submitted = [lab.submit(document) for document in (PRESS, DIAGRAM)]
    jobs = [ended(lab.catalogue, job) for job in submitted]
    assert [job.state for job in jobs] == [JobState.succeeded] * 2
    held = {pid_of(block) for job in submitted for block in lab.catalogue.blocks(job)}
    assert held <= workers.keys()
    for job, document in zip(jobs, (PRESS, DIAGRAM), strict=True):
        assert_same_bits(lab.sealed(job), local(document))
        until(lambda job=job: not lab.settings.running_folder(job.id).exists())


def test_another_worker_goes_on_where_one_was_killed(
    lab: Lab, workers: Workers, local: Local
) -> None:
    submitted = lab.submit(LONG)
    lost = in_mid_block(lab.catalogue, submitted)
    workers.pop(pid_of(lost)).kill()
    job = ended(lab.catalogue, submitted)
    (block,) = lab.catalogue.blocks(submitted)
    assert (job.state, block.attempt) == (JobState.succeeded, 2)
    assert pid_of(block) in workers
    assert_same_bits(lab.sealed(job), local(LONG))


@pytest.mark.parametrize("processes", ["1", "2"])
def test_who_may_not_work_is_told_why(lab: Lab, processes: str) -> None:
    with lab.worker("jobs:write", "--processes", processes) as worker:
        _, said = worker.communicate()
    assert (worker.returncode, "needs a key for worker" in said) == (2, True)
    claim = {"program": "99.0", "worker": "w", "version": "1", "processor": "p", "wait": 0}
    headers = {"Authorization": f"Bearer {lab.keys['worker']}"}
    with httpx.Client(base_url=lab.url, headers=headers, trust_env=False) as http:
        refused = http.post("/v1/worker/claims", json=claim)
        assert (refused.status_code, refused.json()["type"]) == (409, "/problems/other-version")
        assert http.post("/v1/worker/claims", json=claim | {"wait": 1e9}).status_code == 422
        http.headers.pop("Authorization")
        assert http.post("/v1/worker/claims", json=claim).status_code == 401


@pytest.mark.long
def test_a_service_that_was_away_finds_the_work_done(
    lab: Lab, workers: Workers, local: Local
) -> None:
    submitted = lab.submit(LONG)
    worker = workers.pop(pid_of(in_mid_block(lab.catalogue, submitted)))
    lab.stop()
    lab.serve()
    job = ended(lab.catalogue, submitted)
    assert job.state is JobState.succeeded
    assert_same_bits(lab.sealed(job), local(LONG))
    worker.terminate()
    worker.communicate()
    assert worker.returncode == 0


@pytest.mark.long
def test_one_worker_computes_in_several_processes(lab: Lab, workers: Workers) -> None:
    for worker in workers.values():
        worker.terminate()
    for worker in workers.values():
        worker.communicate()
    workers.clear()
    submitted = [lab.submit(LONG | {"duration": 60.0 + number}) for number in range(2)]
    worker = lab.worker("worker", "--processes", "2", "--json")
    blocks = [in_mid_block(lab.catalogue, job) for job in submitted]
    assert len({pid_of(block) for block in blocks} - {worker.pid}) == 2
    worker.terminate()
    worker.communicate()
    assert worker.returncode == 0
    states = {lab.catalogue.blocks(job)[0].state.value for job in submitted}
    assert states <= {"queued", "done"}
