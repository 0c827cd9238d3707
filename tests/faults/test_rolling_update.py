"""A service that gets another version one process after the other, while a study runs."""

import json
import os
import signal
import socket
import subprocess
import sys
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

import pytest
from jobs import IMPATIENT, in_mid_block

from jointplay.chaos.undisturbed import files_of, undisturbed
from jointplay.client import Client
from jointplay.service.processes.broker import Broker
from jointplay.solver.version import SOLVER_VERSION
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import JobState
from jointplay.storage.settings import Settings
from tests.postgresql_server import running_server
from tests.seaweedfs_server import BUCKET, running_store
from tests.waiting import until

NEXT = "99.0.0"
STUDY = {
    "kind": "sweep",
    "scene": {"preset": "seven-bar-press", "parameters": {"friction": 0.05}},
    "grid": {"clearance": {"from": 2e-4, "to": 1e-3, "count": 48}},
    "periods": 150,
    "statistics": ["root_mean_square", "contact_share"],
}
RUN = {"kind": "simulate", "scene": {"preset": "slider-crank"}, "duration": 1.0, "cache": False}


class Programs:
    """Processes of an old version and of a new one over the same servers.

    Both have the same sources: the new one has another number, and so another solver to all others.
    """

    def __init__(self, folder: Path, stack: ExitStack, environment: dict[str, str]) -> None:
        metadata = folder / "next" / f"jointplay-{NEXT}.dist-info" / "METADATA"
        metadata.parent.mkdir(parents=True)
        metadata.write_text(f"Metadata-Version: 2.1\nName: jointplay\nVersion: {NEXT}\n")
        self._next = {"PYTHONPATH": str(folder / "next")}
        self._folder, self._stack, self._environment = folder, stack, environment

    def start(self, module: str, *options: str, new: bool = False) -> "subprocess.Popen[bytes]":
        number = len([*self._folder.glob("data*")])
        data = self._folder / f"data{number}"
        data.mkdir()
        environment = self._environment | (self._next if new else {})
        with (self._folder / f"{module}{number}.log").open("wb") as log:
            process = subprocess.Popen(
                [sys.executable, "-P", "-m", module, *options],
                env=os.environ | environment | {"JOINTPLAY_DATA": str(data)},
                stderr=log,
                start_new_session=True,
            )
        self._stack.callback(end, process, signal.SIGKILL)
        return process

    def api(self, *, new: bool = False) -> tuple["subprocess.Popen[bytes]", Client]:
        with socket.create_server(("127.0.0.1", 0)) as free:
            port = free.getsockname()[1]
        module = "jointplay.service.processes.api"
        process = self.start(module, "--port", str(port), new=new)
        client = self._stack.enter_context(Client(f"http://127.0.0.1:{port}"))

        def answers() -> bool:
            with socket.socket() as asking:
                return asking.connect_ex(("127.0.0.1", port)) == 0

        until(answers)
        return process, client


def end(process: "subprocess.Popen[bytes]", how: signal.Signals = signal.SIGTERM) -> None:
    if process.poll() is None:
        process.send_signal(how) if how is signal.SIGTERM else os.killpg(process.pid, how)
    process.wait()


@contextmanager
def servers(folder: Path) -> Iterator[dict[str, str]]:
    broker = Broker(folder / "broker", folder / "broker.log")
    with running_server() as server, running_store() as endpoint:
        broker.start()
        yield IMPATIENT | {
            "JOINTPLAY_CATALOGUE_URL": server.new("template0"),
            "JOINTPLAY_RESULTS_URL": f"s3://{BUCKET}/rolling?endpoint={endpoint}",
            "JOINTPLAY_REDIS_URL": broker.url,
        }
        broker.stop()


@pytest.mark.long
def test_nothing_fails_when_processes_are_replaced_one_by_one(tmp_path: Path) -> None:
    with servers(tmp_path) as environment, ExitStack() as stack:
        programs = Programs(tmp_path, stack, environment)
        settings = Settings(
            data=tmp_path,
            catalogue_url=environment["JOINTPLAY_CATALOGUE_URL"],
            results_url=environment["JOINTPLAY_RESULTS_URL"],
        )
        catalogue = Catalogue(settings.catalogue_url)
        stack.callback(catalogue.close)
        relays = [programs.start("jointplay.worker.relay") for _ in range(2)]
        (first_api, first), (second_api, second) = programs.api(), programs.api()
        workers = [programs.start("jointplay.worker") for _ in range(2)]
        study = first.submit(STUDY)
        runs = [second.submit(RUN)]
        in_mid_block(catalogue, study.id)

        end(first_api)
        _, first = programs.api(new=True)
        runs += [first.submit(RUN), second.submit(RUN)]
        end(relays[0])
        programs.start("jointplay.worker.relay", new=True)
        newer = programs.start("jointplay.worker", new=True)
        end(second_api)
        _, second = programs.api(new=True)
        end(relays[1])
        programs.start("jointplay.worker.relay", new=True)
        runs.append(second.submit(RUN))
        before = catalogue.get(study.id)
        assert before.state is JobState.running, "it ended before all were replaced"
        end(workers[0])  # the other one stays until the study has ended
        ids = [study.id, *(job.id for job in runs)]
        until(
            lambda: all(catalogue.get(job).state.terminal for job in ids),
            progress=lambda: [(catalogue.get(job), catalogue.blocks(job)) for job in ids],
        )
        end(workers[1])
        runs.append(first.submit(RUN))
        until(lambda: catalogue.get(runs[-1].id).state.terminal)
        assert newer.poll() is None

        old, new = SOLVER_VERSION, SOLVER_VERSION.replace(SOLVER_VERSION.split("+")[0], NEXT)
        versions = {}
        for job in [study, *runs]:
            found = catalogue.get(job.id)
            assert found.state is JobState.succeeded, found.error
            sealed = settings.sealed_run(job.id, found.attempt)
            stored = files_of(settings.sealed_study(job.id) if job is study else sealed)
            versions[job.id] = json.loads(stored["zarr.json"])["attributes"]["solver_version"]
            assert versions[job.id] == found.solver_version
            if job is study:
                assert stored == undisturbed(STUDY, tmp_path / "undisturbed")
        assert [versions[job.id] for job in [study, *runs]] == [old, old, new, old, new, new]
        tries = [one for job in ids for one in catalogue.attempts(job)]
        assert "lost" not in {one.outcome for one in tries}
        assert "released" in {one.outcome for one in tries}
