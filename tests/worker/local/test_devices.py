"""Studies on a device, here and now; this processor does what the driver does."""

import os
import signal
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import Any, cast

import pytest

import jointplay
from jointplay import jobs
from jointplay.records.failure import InvalidInput
from jointplay.solver.kernels.device.driver import Device
from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.kinds import Study, admit
from jointplay.solver.runs.study.device_lanes import device_lanes
from jointplay.solver.runs.study.lane_group import Make
from jointplay.solver.runs.study.required_study import required_study
from jointplay.worker.execute import Outcome
from jointplay.worker.local import computing, restart_points
from jointplay.worker.local.devices import lanes_of
from tests.solver.kernels.device.driver_by_host import DriverByHost

CLEARANCES = [1e-4 + 1e-5 * step for step in range(20)]
DIAGRAM = jobs.bifurcation("slider-crank", "clearance", CLEARANCES, settle=3, record=10)
CHART = {
    "kind": "chart",
    "scene": {"preset": "impact-oscillator"},
    "along": {"parameter": "speed", "values": {"from": 24.0, "to": 40.0, "count": 9}},
    "by": {"parameter": "amplitude", "values": {"from": 2e-3, "to": 9e-3, "count": 5}},
    "settle": 10,
    "record": 6,
    "tolerance": 1e-5,
}
SECTION = {"channel": "rod.omega", "value": 0.0, "direction": "up"}
REFUSED = {
    "/kind": jobs.simulate("slider-crank", duration=1.0),
    "/channels": jobs.sweep("slider-crank", {"clearance": CLEARANCES}, periods=1),
    "/method": DIAGRAM | {"method": "rodas"},
    "/section": DIAGRAM | {"section": SECTION},
}


def by_host(driver: DriverByHost, study: Study) -> Make:
    return device_lanes(Device(library=driver), study)


def by_a_host_of_its_own(study: Study) -> Make:
    return by_host(DriverByHost(), study)


def computed(job: Any, folder: Path, driver: DriverByHost, report: Any) -> Outcome:
    study = required_study(admit(dict(job)))
    folder.mkdir()
    return computing.compute(study, folder, None, report, partial(by_host, driver))


def bytes_of(folder: Path) -> bytes:
    return (folder / computing.STORE).read_bytes()


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("whole") / "OUT"
    jointplay.run(DIAGRAM, output=folder, processes=1)
    return folder


def test_a_diagram_has_the_bytes_of_the_processor(whole: Path, tmp_path: Path) -> None:
    told: list[float] = []
    outcome = computed(
        DIAGRAM, tmp_path / "OUT", DriverByHost(), lambda fraction, _: told.append(fraction)
    )
    assert outcome.state == "succeeded"
    assert told == sorted(told)
    assert bytes_of(tmp_path / "OUT") == bytes_of(whole)


def test_a_chart_does_without_energies_to_the_same_bytes(tmp_path: Path) -> None:
    jointplay.run(CHART, output=tmp_path / "HERE", processes=1)
    outcome = computed(CHART, tmp_path / "THERE", DriverByHost(), lambda *_: None)
    assert outcome.state == "succeeded"
    assert bytes_of(tmp_path / "THERE") == bytes_of(tmp_path / "HERE")


@pytest.mark.long
def test_processes_that_share_a_device_compute_the_same_bytes(whole: Path, tmp_path: Path) -> None:
    study, told = cast(Study, admit(dict(DIAGRAM))), list[str]()
    outcome = computing.compute(
        study, tmp_path, 2, lambda _, note: told.append(note), by_a_host_of_its_own
    )
    assert outcome.state == "succeeded"
    assert told[-1] == "20 of 20 points"
    assert bytes_of(tmp_path) == bytes_of(whole)


@pytest.fixture
def kept_often(monkeypatch: pytest.MonkeyPatch) -> None:
    """Have restart points made between all launches."""
    monkeypatch.setattr(restart_points, "PERIOD", 0.0)
    monkeypatch.setattr(restart_points, "_MOST_OVERHEAD", 0.0)


def under_way(folder: Path) -> Iterator[Path]:
    return (folder / "running" / "study" / "parts").glob("*-a1*")


@pytest.mark.usefixtures("kept_often")
def test_a_lost_device_loses_nothing_and_the_processor_goes_on(
    whole: Path, tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    driver, folder = DriverByHost(), tmp_path / "OUT"

    def report(fraction: float, _: str) -> None:
        if fraction > 0.0:
            driver.lost_at = driver.launches + 1  # the next one: some lanes are fetched first

    outcome = computed(DIAGRAM, folder, driver, report)
    assert outcome.error is not None
    assert (outcome.state, outcome.error.code) == ("failed", "device-lost")
    assert "--resume" in outcome.error.detail
    assert any(under_way(folder))
    assert jointplay.resume(folder, processes=1).state == "succeeded"
    assert "anew" not in caplog.text
    assert bytes_of(folder) == bytes_of(whole)


def test_a_signal_ends_a_study_which_goes_on_here(
    whole: Path, tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    folder = tmp_path / "OUT"

    def report(fraction: float, _: str) -> None:
        if fraction > 0.0:
            os.kill(os.getpid(), signal.SIGTERM)

    outcome = computed(DIAGRAM, folder, DriverByHost(), report)
    assert (outcome.state, 0.0 < outcome.fraction < 1.0) == ("cancelled", True)
    assert any(under_way(folder))
    assert jointplay.resume(folder, processes=1).state == "succeeded"
    assert "anew" not in caplog.text
    assert bytes_of(folder) == bytes_of(whole)


def test_a_device_goes_on_with_what_was_begun_here(whole: Path, tmp_path: Path) -> None:
    folder = tmp_path / "OUT"
    folder.mkdir()

    def report(fraction: float, _: str) -> None:
        if fraction > 0.3:
            os.kill(os.getpid(), signal.SIGTERM)

    study = cast(Study, admit(dict(DIAGRAM)))
    assert computing.compute(study, folder, 1, report).state == "cancelled"
    outcome = computing.compute(study, folder, None, lambda *_: None, by_a_host_of_its_own)
    assert outcome.state == "succeeded"
    assert bytes_of(folder) == bytes_of(whole)


def test_a_device_with_little_memory_has_fewer_lanes() -> None:
    study = required_study(admit(dict(DIAGRAM)))
    kernel = ready_kernel(study.point_scene(0), study.job["formulation"], study.method)
    many, little = DriverByHost(), DriverByHost()
    more = by_host(many, study)(kernel, watch=False, tangents=None, keep_steps=0)
    little.memory = sum(one.nbytes for one in many.held.values()) - 1
    fewer = by_host(little, study)(kernel, watch=False, tangents=None, keep_steps=0)
    assert (more.width, fewer.width) == (len(CLEARANCES), len(CLEARANCES) // 2)


def test_a_device_without_memory_is_told(tmp_path: Path) -> None:
    point = jobs.bifurcation("slider-crank", "clearance", CLEARANCES[:1], settle=3, record=10)
    outcome = computed(point, tmp_path / "OUT", DriverByHost(memory=2**10), lambda *_: None)
    assert outcome.error is not None
    assert "OUT_OF_MEMORY" in outcome.error.detail


@pytest.mark.parametrize("pointer", REFUSED)
def test_what_no_device_computes_is_refused(pointer: str) -> None:
    with pytest.raises(InvalidInput, match="the processor computes it") as refused:
        lanes_of("cuda:0", admit(dict(REFUSED[pointer])))
    assert [problem.pointer for problem in refused.value.problems] == [pointer]


def test_the_processor_is_no_device_and_computes_what_none_does() -> None:
    assert lanes_of("cpu", admit(dict(DIAGRAM))) is None
    assert lanes_of("auto", admit(dict(REFUSED["/channels"]))) is None
