"""A worker that dies in mid-job costs time, never a bit of the result."""

import os
import signal
from pathlib import Path

import pytest
from jobs import IMPATIENT, Service, ended, in_mid_block, pid_of, submit

from jointplay.service.processes import running_service
from jointplay.solver.kinds import Admission, admit
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import Job, JobState
from jointplay.storage.object_stores import StoredObject
from jointplay.storage.results.reader import ResultReader
from jointplay.storage.settings import Settings
from jointplay.worker.execute import execute
from tests.stores import files_of, packed, sealed_run, target
from tests.waiting import until

# some 2 s of computing; more samples than one shard holds, contacts at both joints all along
JOB = {
    "kind": "simulate",
    "scene": {"preset": "seven-bar-press", "parameters": {"clearance": 5e-4, "friction": 0.1}},
    "duration": 200.0,
    "output_step": 2e-3,
    "channels": ["slider7.*", "A.*"],
    "section": {"crank_angle": 0.0},
}


@pytest.fixture(scope="module")
def admission() -> Admission:
    return admit(JOB)


@pytest.fixture(scope="module")
def undisturbed(admission: Admission, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("undisturbed") / "store"
    ended = execute(admission, folder, target(folder), report=lambda _: "continue")
    assert ended.state == "succeeded"
    return packed(folder)


def arrays(store: Path | StoredObject) -> dict[str, bytes]:
    """Every chunk of every array, and what describes it, by its key."""
    return {key: content for key, content in files_of(store).items() if "/" in key}


def assert_same_bits(settings: Settings, job: Job, undisturbed: Path) -> None:
    store = settings.sealed_run(job.id, job.attempt)
    stored, expected = arrays(store), arrays(undisturbed)
    assert len(expected) > 50
    assert stored.keys() == expected.keys()
    assert [key for key in expected if stored[key] != expected[key]] == []
    reader = sealed_run(settings, job)
    assert reader.attributes["job"] == ResultReader(undisturbed).attributes["job"]
    assert reader.complete
    reader.verify()


def test_a_block_goes_on_where_its_killed_worker_left_it(
    service: Service, admission: Admission, undisturbed: Path
) -> None:
    settings, catalogue = service
    job = submit(catalogue, admission)
    fraction = 0.0
    for _ in range(2):
        held = in_mid_block(catalogue, job, after=fraction)
        os.kill(pid_of(held), signal.SIGKILL)
        fraction = catalogue.blocks(job)[0].progress_fraction
        until(lambda: catalogue.get(job).attempt > held.attempt)  # noqa: B023
        until(lambda: catalogue.get(job).progress_fraction != fraction)  # noqa: B023
        # what was recorded came with a restart point: it goes on from there, not from zero
        assert catalogue.get(job).progress_fraction > fraction
    finished = ended(catalogue, job)
    assert finished.state is JobState.succeeded
    outcomes = [attempt.outcome for attempt in catalogue.attempts(job)]
    assert outcomes[:2] == ["lost", "lost"]
    assert outcomes[-1] == "done"
    assert_same_bits(settings, finished, undisturbed)
    until(lambda: not settings.running_folder(job).exists())
    left = list(settings.object_store.list(settings.results_prefix(job)))
    assert left == [settings.sealed_run(job, finished.attempt).key]


@pytest.mark.long
def test_a_whole_worker_killed_is_replaced(
    settings: Settings, catalogue: Catalogue, admission: Admission, undisturbed: Path
) -> None:
    with running_service(settings.data, environment=IMPATIENT):
        job = submit(catalogue, admission)
        child = pid_of(in_mid_block(catalogue, job))
        stat = Path(f"/proc/{child}/stat").read_text()
        os.kill(int(stat.rsplit(")", 1)[1].split()[1]), signal.SIGKILL)
        finished = ended(catalogue, job)
    assert finished.state is JobState.succeeded
    assert finished.attempt >= 2
    assert_same_bits(settings, finished, undisturbed)


@pytest.mark.long
def test_a_service_that_is_stopped_goes_on_when_it_is_started_again(
    settings: Settings, catalogue: Catalogue, admission: Admission, undisturbed: Path
) -> None:
    with running_service(settings.data):
        job = submit(catalogue, admission)
        until(lambda: catalogue.get(job).progress_fraction > 0)
    stopped = catalogue.blocks(job)[0]
    assert stopped.losses == 0  # given back, not lost: no lease has to run out
    assert stopped.checkpoint is not None
    with running_service(settings.data):
        finished = ended(catalogue, job)
    assert finished.state is JobState.succeeded
    assert [a.outcome for a in catalogue.attempts(job)] == ["released", "done"]
    assert_same_bits(settings, finished, undisturbed)


def test_a_cancelled_job_keeps_what_it_computed(service: Service, admission: Admission) -> None:
    settings, catalogue = service
    job = submit(catalogue, admission)
    in_mid_block(catalogue, job)
    assert catalogue.request_cancel(job).state is JobState.cancelling
    reached = catalogue.get(job).progress_fraction
    finished = ended(catalogue, job)
    assert finished.state is JobState.cancelled
    # it goes on for a slice of a quarter second, of some two seconds in all
    assert finished.progress_fraction < reached + 0.5
    reader = sealed_run(settings, finished)
    assert not reader.complete
    reader.verify()
    when, values = reader.history(["slider7.x"])
    assert 0 < len(when) < admission.samples
    assert len(values["slider7.x"]) == len(when)
