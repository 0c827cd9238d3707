"""Blocks that a worker computes together on a device; this processor does what the driver does."""

import threading
import time
from collections.abc import Mapping
from functools import partial
from typing import Any

import pytest
from one_block import run

import jointplay
from jointplay.solver.kernels.device.driver import Device, DeviceError
from jointplay.solver.kinds import Admission, Study, admit
from jointplay.solver.runs.study.device_lanes import device_lanes
from jointplay.solver.runs.study.lane_group import Make
from jointplay.solver.version import SOLVER_VERSION
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.counters import ON_DEVICES
from jointplay.storage.catalogue.errors import SILENT, Unavailable
from jointplay.storage.catalogue.records import BlockState, JobState, NewJob, WorkerDevice
from jointplay.storage.settings import Settings
from jointplay.worker import block_run, tasks
from jointplay.worker.device_run import compute_on_device
from jointplay.worker.lease import Lease
from jointplay.worker.local.devices import opener
from jointplay.worker.local.folder import STORE
from jointplay.worker.own_blocks import OwnBlocks
from jointplay.worker.own_device import OwnDevice
from jointplay.worker.spent import SpentReport
from tests.solver.kernels.device.driver_by_host import DriverByHost
from tests.stores import files_of
from tests.waiting import until

CLEARANCES = [1e-4 + 1e-5 * step for step in range(20)]
JOB = jointplay.jobs.bifurcation("slider-crank", "clearance", CLEARANCES, settle=3, record=10)


def by_host(driver: DriverByHost, study: Study) -> Make:
    return device_lanes(Device(library=driver), study)


class Launches(DriverByHost):
    """A driver that calls back before each launch."""

    def __init__(self, before: Any = lambda launches: None) -> None:
        super().__init__()
        self._before = before

    def cuLaunchKernel(self, *given: Any) -> int:  # noqa: N802
        self._before(self.launches)
        return super().cuLaunchKernel(*given)


@pytest.fixture
def study(catalogue: Catalogue) -> str:
    return submit(catalogue, JOB)


def submit(catalogue: Catalogue, job: Mapping[str, Any]) -> str:
    admitted = admit(dict(job))
    assert isinstance(admitted, Study)
    new = NewJob(
        "bifurcation",
        admitted.job,
        admitted.digest,
        SOLVER_VERSION,
        blocks=admitted.blocks,
        seal=True,
    )
    return catalogue.submit(new).job.id


def compute(
    catalogue: Catalogue,
    settings: Settings,
    study: str,
    driver: DriverByHost,
    draining: threading.Event | None = None,
    block: int = 0,
) -> None:
    claim = catalogue.claim_block(f"{study}-{block}", "this process", settings.lease)
    assert claim is not None
    event = draining or threading.Event()
    try:
        blocks = OwnBlocks(catalogue, settings, event)
        compute_on_device(blocks, claim, event, partial(by_host, driver))
    finally:
        assert not driver.held


def finish(catalogue: Catalogue, settings: Settings, study: str) -> dict[str, bytes]:
    """Compute here what is left; return the files of the results."""
    for block in catalogue.blocks(study):
        if block.state is not BlockState.done:
            run(catalogue, settings, block.id)
    assert catalogue.get(study).state is JobState.succeeded
    return files_of(settings.sealed_study(study))


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    """The files of the results of one processor."""
    folder = tmp_path_factory.mktemp("whole") / "OUT"
    jointplay.run(JOB, output=folder, processes=1)
    return files_of(folder / STORE)


def test_blocks_are_computed_together_beside_those_of_others(
    catalogue: Catalogue, settings: Settings, study: str, whole: dict[str, bytes]
) -> None:
    run(catalogue, settings, f"{study}-1")
    driver = DriverByHost()
    spent_report = SpentReport()
    compute(catalogue, settings, study, driver)
    assert spent_report.unsent()[ON_DEVICES] == len(CLEARANCES) - admit(dict(JOB)).blocks[1][1]
    *blocks, seal = catalogue.blocks(study)
    assert {block.state for block in blocks} == {BlockState.done}
    assert {block.attempt for block in blocks} == {1}
    assert catalogue.get(study).progress_fraction == 1.0
    assert seal.state is BlockState.queued
    launches = driver.launches
    compute(catalogue, settings, study, driver, block=seal.index)
    assert driver.launches == launches
    assert finish(catalogue, settings, study) == whole


def test_blocks_that_wait_for_one_whose_end_cannot_be_told_have_not_stalled(
    catalogue: Catalogue, settings: Settings, study: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    leases: list[Lease] = []
    enter, finish_block = Lease.__enter__, catalogue.finish
    failed_at: list[float] = []
    advanced: list[float] = []

    def entered(lease: Lease) -> Lease:
        leases.append(lease)
        return enter(lease)

    def fails_twice(*given: Any) -> JobState:
        if len(failed_at) == 1:
            now = time.monotonic()
            advanced.extend(now - lease._advance.age() for lease in leases)
        if len(failed_at) < 2:
            failed_at.append(time.monotonic())
            raise Unavailable(SILENT)
        return finish_block(*given)

    monkeypatch.setattr(block_run, "ASK_AGAIN", 0.01)
    monkeypatch.setattr(Lease, "__enter__", entered)
    monkeypatch.setattr(catalogue, "finish", fails_twice)
    compute(catalogue, settings, study, DriverByHost())
    assert len(advanced) > 1
    assert min(advanced) >= failed_at[0]


def test_a_worker_that_shall_end_gives_all_blocks_back_with_restart_points(
    catalogue: Catalogue, settings: Settings, study: str, whole: dict[str, bytes]
) -> None:
    draining = threading.Event()

    def before(launches: int) -> None:
        if launches > 4:
            draining.set()

    compute(catalogue, settings, study, Launches(before), draining)
    *blocks, _ = catalogue.blocks(study)
    assert {block.state for block in blocks} == {BlockState.queued}
    assert {block.losses for block in blocks} == {0}
    assert sum(block.checkpoint is not None for block in blocks) > 1
    assert any(0.0 < block.progress_fraction < 1.0 for block in blocks)
    assert finish(catalogue, settings, study) == whole


def test_a_lost_device_loses_nothing_but_time(
    catalogue: Catalogue, settings: Settings, study: str, whole: dict[str, bytes]
) -> None:
    driver = DriverByHost()
    driver.lost_at = 5
    with pytest.raises(DeviceError, match="LAUNCH_FAILED"):
        compute(catalogue, settings, study, driver)
    *blocks, _ = catalogue.blocks(study)
    assert {block.state for block in blocks} == {BlockState.queued}
    assert {block.losses for block in blocks} == {0}
    assert {one.outcome for one in catalogue.attempts(study)} == {"put-off"}
    assert catalogue.get(study).activity == "waiting for a device"
    assert finish(catalogue, settings, study) == whole


def test_where_no_device_can_be_opened_the_processor_computes(
    catalogue: Catalogue, settings: Settings, study: str
) -> None:
    claim = catalogue.claim_block(f"{study}-0", "this process", settings.lease)
    assert claim is not None
    event = threading.Event()
    blocks = OwnBlocks(catalogue, settings, event)
    with pytest.raises(DeviceError, match="cannot be opened"):
        compute_on_device(blocks, claim, event, opener("cuda:9999"))
    assert catalogue.blocks(study)[0].state is BlockState.done


def test_a_cancelled_study_ends_between_launches(
    catalogue: Catalogue, settings: Settings, study: str
) -> None:
    def before(launches: int) -> None:
        if launches == 5:
            catalogue.request_cancel(study)

    compute(catalogue, settings, study, Launches(before))
    assert catalogue.get(study).state is JobState.cancelled
    assert catalogue.get(study).progress_fraction < 1.0


def test_what_no_device_computes_the_processor_does(
    catalogue: Catalogue, settings: Settings, admission: Admission
) -> None:
    new = NewJob("simulate", admission.job | {"duration": 0.01}, "0" * 64, SOLVER_VERSION)
    job, driver = catalogue.submit(new).job.id, DriverByHost()
    compute(catalogue, settings, job, driver)
    assert catalogue.get(job).state is JobState.succeeded
    assert driver.launches == 0


def test_a_worker_that_lost_its_device_goes_on_with_the_processor(
    catalogue: Catalogue, settings: Settings, study: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    driver = DriverByHost()
    device = OwnDevice("cuda:0", WorkerDevice("this processor", 1e6, 512))
    monkeypatch.setattr(tasks, "_platform", lambda: (settings, catalogue))
    monkeypatch.setattr(tasks, "opener", lambda name: partial(by_host, driver))
    monkeypatch.setattr(tasks, "_device", device)
    driver.lost_at = 5
    tasks.run_block(f"{study}-0")
    assert tasks._device is None
    launches, other = driver.launches, submit(catalogue, JOB | {"record": 1})

    def is_done() -> bool:
        return catalogue.blocks(other)[0].state is BlockState.done

    # where it takes seconds, the blocks that were put off come first
    until(is_done, act=lambda: tasks.run_block(f"{other}-0"))
    assert driver.launches == launches
