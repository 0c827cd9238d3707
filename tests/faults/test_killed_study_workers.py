"""A study whose workers die, stall or are cut off has the bytes of an undisturbed one."""

import os
import signal

import pytest
from jobs import IMPATIENT, Service, ended, in_mid_block, pid_of
from studies import assert_same_bytes, stalled, submit, undisturbed_files

from jointplay.service.processes import running_service
from jointplay.solver.kinds import Study, admit
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import JobState
from jointplay.storage.settings import Settings
from jointplay.storage.studies.reader import StudyReader
from tests.waiting import until

# two blocks of more than a second of computing each; contacts at both joints all along
JOB = {
    "kind": "bifurcation",
    "scene": {"preset": "seven-bar-press", "parameters": {"friction": 0.1}},
    "parameter": "clearance",
    "values": {"from": 2e-4, "to": 1e-3, "count": 16},
    "settle": 50,
    "record": 150,
}


@pytest.fixture(scope="module")
def study() -> Study:
    study = admit(JOB)
    assert isinstance(study, Study)
    assert len(study.blocks) == 2
    return study


@pytest.fixture(scope="module")
def undisturbed(study: Study, tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    return undisturbed_files(study, tmp_path_factory.mktemp("undisturbed") / "study")


def test_blocks_go_on_where_their_killed_workers_left_them(
    service: Service, study: Study, undisturbed: dict[str, bytes]
) -> None:
    settings, catalogue = service
    job = submit(catalogue, study)
    for index in (0, 1):  # one after the other, while both are computed
        os.kill(pid_of(in_mid_block(catalogue, job, index)), signal.SIGKILL)
    reached = catalogue.blocks(job)[0].progress_fraction
    again = in_mid_block(catalogue, job, 0, after=reached)
    # what was recorded came with a restart point: it goes on from there, not from zero
    assert again.attempt == 2
    os.kill(pid_of(again), signal.SIGKILL)
    finished = ended(catalogue, job)
    outcomes = [attempt.outcome for attempt in catalogue.attempts(job)]
    assert outcomes.count("lost") == 3
    assert outcomes.count("done") == 3  # two blocks, and the one that seals
    assert_same_bytes(settings, finished, undisturbed)


@pytest.mark.long
def test_a_stopped_service_goes_on_with_a_study(
    settings: Settings, catalogue: Catalogue, study: Study, undisturbed: dict[str, bytes]
) -> None:
    with running_service(settings.data):
        job = submit(catalogue, study)
        in_mid_block(catalogue, job, 0)
    with running_service(settings.data, workers=2):
        finished = ended(catalogue, job)
    assert "lost" not in [attempt.outcome for attempt in catalogue.attempts(job)]
    assert_same_bytes(settings, finished, undisturbed)


@pytest.mark.long
@pytest.mark.parametrize("when", ["another has its block", "the study is sealed"])
def test_a_worker_that_comes_back_late_changes_no_byte(
    settings: Settings,
    catalogue: Catalogue,
    study: Study,
    undisturbed: dict[str, bytes],
    when: str,
) -> None:
    with running_service(settings.data, workers=2, environment=IMPATIENT):
        job = submit(catalogue, study)
        held = in_mid_block(catalogue, job, 0)
        with stalled(settings, pid_of(held)):
            if when == "another has its block":
                until(lambda: catalogue.blocks(job)[0].attempt > held.attempt)
            else:
                finished = ended(catalogue, job)
                assert_same_bytes(settings, finished, undisturbed)
        finished = ended(catalogue, job)
        # it finds out and goes back to work
        other = submit(catalogue, study)
        again = ended(catalogue, other)
    log = (settings.data / "logs" / "worker.log").read_text()
    assert f"attempt {held.attempt} does not hold block {held.id} (any more); leaving it" in log
    assert_same_bytes(settings, finished, undisturbed)
    assert_same_bytes(settings, again, undisturbed)


def test_a_cancelled_study_ends_soon_and_keeps_what_it_computed(
    service: Service, study: Study
) -> None:
    settings, catalogue = service
    job = submit(catalogue, study)
    in_mid_block(catalogue, job, 0, after=0.3)
    assert catalogue.request_cancel(job).state is JobState.cancelling
    reached = catalogue.blocks(job)[0].progress_fraction
    finished = ended(catalogue, job)
    assert finished.state is JobState.cancelled
    # it goes on for a slice of a quarter second and a restart point, of some two seconds in all
    assert catalogue.blocks(job)[0].progress_fraction < reached + 0.5
    reader = StudyReader(settings.running_study(job))
    assert not reader.complete
    assert reader.counts[:8].min() > 0
    assert (reader.status[:8] >= 1).all()
