"""A worker that joined with a device: the bytes of a run on the processor, whatever becomes of it.

This processor does what the device does.
"""

import threading
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

import pytest

import jointplay
from jointplay.solver.kernels.device.host_driver import FAILING
from jointplay.storage.catalogue.counters import ON_DEVICES
from jointplay.storage.catalogue.records import Job, WorkerDevice
from jointplay.worker.joined.connection import Connection
from jointplay.worker.joined.loop import work
from jointplay.worker.local.folder import STORE
from jointplay.worker.own_device import OwnDevice
from tests.joined_by_hand import Installation, installation
from tests.stores import files_of

CLEARANCES = [1e-4 + 1e-5 * step for step in range(20)]
DIAGRAM = jointplay.jobs.bifurcation("slider-crank", "clearance", CLEARANCES, settle=3, record=10)
DEVICE = OwnDevice("host", WorkerDevice("this processor", 1e6, 256))


@pytest.fixture(scope="module")
def service(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Installation]:
    with installation("folder", tmp_path_factory.mktemp("service") / "data") as found:
        yield found


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    """The files of the results of one processor."""
    folder = tmp_path_factory.mktemp("whole") / "OUT"
    jointplay.run(DIAGRAM, output=folder, processes=1)
    return files_of(folder / STORE)


def computed(service: Installation, idle: float) -> tuple[Job, int]:
    """Have a worker with a device compute the diagram; return the job, and the worker's count."""
    job = service.submit(dict(DIAGRAM))
    with closing(Connection(service.url, None)) as connection:
        blocks = work(connection, threading.Event(), idle, DEVICE)
    return service.catalogue.get(job.id), blocks


def points_on_devices(service: Installation) -> float:
    return service.catalogue.census().totals.get(ON_DEVICES, 0.0)


def test_blocks_are_claimed_and_computed_together(
    service: Installation, whole: dict[str, bytes]
) -> None:
    before = points_on_devices(service)
    job, blocks = computed(service, 1.0)
    assert job.state == "succeeded"
    assert service.outcomes(job) == ["done"] * blocks == ["done"] * 4  # one of them seals
    assert points_on_devices(service) - before == len(CLEARANCES)
    *points, _ = service.catalogue.attempts(job.id)
    assert max(one.started for one in points) < min(one.ended or 0.0 for one in points)
    (told,) = service.catalogue.workers_at_work()
    assert (told.device, told.rate, told.lanes) == ("this processor", 1e6, 256)
    assert files_of(service.settings.sealed_study(job.id)) == whole


def test_a_device_that_fails_loses_nothing_and_is_told_of_no_more(
    service: Installation,
    whole: dict[str, bytes],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    (tmp_path / "fails").write_text("lost")
    monkeypatch.setenv(FAILING, str(tmp_path / "fails"))
    before = points_on_devices(service)
    job, _ = computed(service, 4.0)  # longer than a block that is put off waits
    assert job.state == "succeeded"
    assert service.outcomes(job).count("put-off") >= 1
    assert "lost" not in service.outcomes(job)
    assert points_on_devices(service) == before
    (told,) = service.catalogue.workers_at_work()
    assert told.device is None
    assert files_of(service.settings.sealed_study(job.id)) == whole
