"""Losses count against a block only where the worker could reach whoever keeps the catalogue."""

import pytest
from stepped_clock import Clock

from jointplay.storage.catalogue import ending
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import JobState, NewJob, Solver

NEW = NewJob("simulate", {}, "d" * 64, "1")
SOLVER = Solver("1", "zen4")
LEASE, PAUSE = 30.0, 120.0


def lost(catalogue: Catalogue, clock: Clock, job: str, worker: str) -> int:
    """Have a worker claim a job's only block and be silent; return the attempt's number."""
    catalogue.note_worker(worker, SOLVER)
    claim = catalogue.claim_block(f"{job}-0", worker, LEASE)
    assert claim is not None
    clock.now += LEASE + 1
    catalogue.reap(3)
    clock.now += PAUSE
    return claim.block.attempt


def test_a_worker_that_comes_back_has_lost_nothing(catalogue: Catalogue, clock: Clock) -> None:
    job = catalogue.submit(NEW).job.id
    for _ in range(5):
        attempt = lost(catalogue, clock, job, "k@host:1:2:boot:3")
        catalogue.note_cut_off(f"{job}-0", attempt, "other@")
        assert catalogue.blocks(job)[0].losses == 1
        for _ in range(2):  # told twice, counted once
            catalogue.note_cut_off(f"{job}-0", attempt, "k@")
            assert catalogue.blocks(job)[0].losses == 0
    assert catalogue.get(job).state is JobState.running


def test_machines_that_were_not_heard_of_since_do_not_count(
    catalogue: Catalogue, clock: Clock
) -> None:
    job = catalogue.submit(NEW).job.id
    machines = [f"k@host{number}:1:2:boot{number}:3" for number in range(4)]
    for worker in machines:
        lost(catalogue, clock, job, worker)
        assert catalogue.get(job).state is JobState.running
    for worker in machines[:2]:  # other processes of the same machines
        catalogue.note_worker(worker.replace(":1:2:", ":7:8:"), SOLVER)
    lost(catalogue, clock, job, "k@host9:1:2:boot9:3")
    found = catalogue.get(job)
    assert found.state is JobState.failed
    assert found.error is not None
    assert found.error.code == "worker-lost"


def test_a_worker_that_says_so_again_and_again_is_believed_so_often(
    catalogue: Catalogue, clock: Clock, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(ending, "MOST_CUT_OFF", 4)
    job = catalogue.submit(NEW).job.id
    for _ in range(4 + 3):
        assert catalogue.get(job).state is not JobState.failed
        attempt = lost(catalogue, clock, job, "k@host:1:2:boot:3")
        catalogue.note_cut_off(f"{job}-0", attempt, "k@")
    assert catalogue.get(job).state is JobState.failed
