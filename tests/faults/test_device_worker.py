"""A chart by a worker with a device and two without has its bytes, whatever becomes of the device.

The processor does what the device does.
"""

import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path

import pytest
from jobs import IMPATIENT, Service, catalogue_of, ended, pid_of
from studies import assert_same_bytes, stalled, submit, undisturbed_files

from jointplay.service.processes import running_service
from jointplay.solver.kernels.device.host_driver import FAILING
from jointplay.solver.kinds import Study, admit
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import Block, BlockState
from jointplay.storage.settings import Settings
from tests.waiting import is_alive, until

CHART = {
    "kind": "chart",
    "scene": {"preset": "impact-oscillator"},
    "along": {"parameter": "speed", "values": {"from": 24.0, "to": 40.0, "count": 16}},
    "by": {"parameter": "amplitude", "values": {"from": 2e-3, "to": 9e-3, "count": 8}},
    "settle": 300,
    "record": 6,
    "indicators": ["recurrence"],
    "tolerance": 1e-5,
}
"""Eight blocks of half a second each."""
SETTINGS = IMPATIENT | {"JOINTPLAY_LEASE": "300"}
"""Nothing is lost because a machine is slow: of a process of its own it is known that it ended."""


@pytest.fixture(scope="module")
def study() -> Study:
    study = admit(dict(CHART))
    assert isinstance(study, Study)
    return study


@pytest.fixture(scope="module")
def undisturbed(study: Study, tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    return undisturbed_files(study, tmp_path_factory.mktemp("undisturbed") / "study")


@pytest.fixture(scope="module")
def failure(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The file that says how the device fails."""
    return tmp_path_factory.mktemp("device") / "fails"


@pytest.fixture(scope="module")
def service(tmp_path_factory: pytest.TempPathFactory, failure: Path) -> Iterator[Service]:
    """Two workers, and one with a device, which begins anew when it is killed."""
    settings = Settings(data=tmp_path_factory.mktemp("service") / "data")
    own = {
        "JOINTPLAY_DATA": str(settings.data),
        "JOINTPLAY_REDIS_URL": f"unix://{settings.data / 'broker' / 'redis.sock'}",
        "JOINTPLAY_DEVICE": "host",
        FAILING: str(failure),
    }
    with ExitStack() as stack:
        catalogue = stack.enter_context(catalogue_of(settings))
        stack.enter_context(running_service(settings.data, workers=2, environment=SETTINGS))
        log = stack.enter_context((settings.data / "logs" / "device.log").open("wb"))
        command = [sys.executable, "-P", "-m", "jointplay.worker"]
        worker = subprocess.Popen(command, env=os.environ | SETTINGS | own, stderr=log)
        stack.enter_context(worker)
        stack.callback(worker.terminate)
        yield Service(settings, catalogue)


def holders(catalogue: Catalogue, job: str) -> dict[int, list[Block]]:
    """Return the blocks that each process has."""
    found: dict[int, list[Block]] = {}
    for block in catalogue.blocks(job):
        if block.state is BlockState.running:
            found.setdefault(pid_of(block), []).append(block)
    return found


def with_device(catalogue: Catalogue) -> list[int]:
    """Return the processes that have a device; of one that was killed this is known later."""
    found = (int(one.name.split(":")[1]) for one in catalogue.workers_at_work() if one.device)
    return [pid for pid in found if is_alive(pid)]


@pytest.mark.parametrize("fault", ["killed", "lost", "memory"])
def test_a_device_that_fails_beside_processors_changes_no_byte(
    service: Service,
    study: Study,
    undisturbed: dict[str, bytes],
    failure: Path,
    fault: str,
) -> None:
    settings, catalogue = service
    until(lambda: len(with_device(catalogue)) == 1)
    (device,) = with_device(catalogue)
    job = submit(catalogue, study)
    until(lambda: len(holders(catalogue, job)) == 3)
    others = holders(catalogue, job).keys() - {device}
    with ExitStack() as stack:
        for process in others:  # until the device has all the rest
            stack.enter_context(stalled(settings, process))
        until(lambda: some_kept(holders(catalogue, job).get(device, [])))
        if fault != "killed":
            failure.write_text(fault)
            until(lambda: not with_device(catalogue))
        os.kill(device, signal.SIGKILL)
        failure.unlink(missing_ok=True)
    finished = ended(catalogue, job)
    ends = [one.outcome for one in catalogue.attempts(job)]
    assert ends.count("done") == len(study.blocks) + 1
    assert ("lost" if fault == "killed" else "put-off") in ends
    for log in ("worker", "device"):  # restart points of either are good for the other
        assert "begins anew" not in (settings.data / "logs" / f"{log}.log").read_text()
    assert_same_bytes(settings, finished, undisturbed)


def some_kept(blocks: list[Block]) -> bool:
    """Whether there are several blocks, of which some have restart points."""
    kept = [one for one in blocks if one.checkpoint is not None and one.progress_fraction > 0.0]
    return len(blocks) > 2 and len(kept) > 1
