"""Blocks belong to one solver: its version, and the class of processors that began the job."""

from collections.abc import Callable
from dataclasses import replace

import pytest
from stepped_clock import Clock

from jointplay.storage.catalogue import solvers
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import BlockState, NewJob, Solver

OLD, NEW = Solver("1", "skylake"), Solver("2", "skylake")
OTHER = replace(OLD, processor="zen4")
RUN = NewJob("simulate", {}, "d" * 64, "1")
STUDY = NewJob("sweep", {}, "d" * 64, "1", blocks=((0, 1), (1, 1)), seal=True)


@pytest.fixture
def claim(catalogue: Catalogue) -> Callable[..., object]:
    def claim(block: str, solver: Solver, worker: str = "worker") -> object:
        return catalogue.claim_block(block, worker, 30, solver)

    return claim


def test_a_worker_claims_what_its_solver_admitted(
    catalogue: Catalogue, claim: Callable[..., object]
) -> None:
    catalogue.note_worker("old", OLD)
    job = catalogue.submit(RUN).job.id
    assert catalogue.claim_next("new", 30, NEW) is None
    assert claim(f"{job}-0", NEW) is None
    assert catalogue.get(job).processor is None
    assert claim(f"{job}-0", OLD)
    assert catalogue.get(job).processor == OLD.processor


def test_a_study_stays_with_the_class_of_processors_that_began_it(
    catalogue: Catalogue, claim: Callable[..., object], clock: Clock
) -> None:
    job = catalogue.submit(STUDY).job.id
    assert claim(f"{job}-0", OLD)
    clock.now += 2 * solvers.PATIENCE  # nobody is there any more, and it has begun
    assert claim(f"{job}-1", OTHER) is None
    assert claim(f"{job}-1", NEW) is None
    assert claim(f"{job}-1", OLD)
    assert catalogue.get(job).solver_version == OLD.version


def test_a_job_that_no_solver_of_its_version_will_begin_is_taken_by_another(
    catalogue: Catalogue, clock: Clock
) -> None:
    catalogue.note_worker("old", OLD)
    job = catalogue.submit(STUDY).job.id
    clock.now += solvers.PATIENCE / 2
    assert catalogue.claim_next("new", 30, NEW) is None
    clock.now += solvers.PATIENCE
    claimed = catalogue.claim_next("new", 30, NEW)
    assert claimed is not None
    assert claimed.job == catalogue.get(job)
    assert (claimed.job.solver_version, claimed.job.processor) == (NEW.version, NEW.processor)


def test_a_run_that_another_solver_takes_over_begins_anew(
    catalogue: Catalogue, claim: Callable[..., object], clock: Clock
) -> None:
    job = catalogue.submit(RUN).job.id
    assert claim(f"{job}-0", OLD)
    catalogue.record_checkpoint(f"{job}-0", 1, watermark=5, checkpoint="block0-a1")
    catalogue.release(f"{job}-0", 1)
    clock.now += 2 * solvers.PATIENCE
    assert claim(f"{job}-0", NEW)
    (block,) = catalogue.blocks(job)
    assert (block.attempt, block.checkpoint, block.watermark) == (2, None, 0)


def test_a_wake_up_that_reached_another_solver_is_sent_again_soon(
    catalogue: Catalogue, clock: Clock
) -> None:
    catalogue.note_worker("old", OLD)
    job = catalogue.submit(RUN).job.id
    catalogue.mark_published((f"{job}-0",), 1000.0)
    assert catalogue.claim_next("new", 30, NEW) is None
    catalogue.wake_again(f"{job}-0", NEW)
    assert catalogue.due_wake_ups(10) == ()
    clock.now += 1.5
    assert [wake_up.block for wake_up in catalogue.due_wake_ups(10)] == [f"{job}-0"]


def test_a_job_whose_solver_no_worker_has_says_so(
    catalogue: Catalogue, claim: Callable[..., object], clock: Clock
) -> None:
    job = catalogue.submit(STUDY).job.id
    assert claim(f"{job}-0", OLD)
    catalogue.note_worker("old", OLD)
    clock.now += 2 * solvers.PATIENCE
    catalogue.note_worker("old", OLD)
    catalogue.note_unserved()
    assert catalogue.get(job).activity is None
    catalogue.forget_workers(["old"])
    catalogue.note_worker("new", NEW)
    catalogue.note_unserved()
    assert catalogue.unserved() == {job: OLD}
    assert catalogue.get(job).activity == solvers.UNSERVED


def test_a_job_that_waits_its_turn_says_no_more_that_no_worker_has_its_solver(
    catalogue: Catalogue, clock: Clock
) -> None:
    """It said so until it was claimed, an hour later: whoever believed that cancelled it."""
    waiting, cancelled = (catalogue.submit(STUDY).job.id for _ in range(2))
    clock.now += 2 * solvers.PATIENCE
    catalogue.note_unserved()
    assert catalogue.get(waiting).activity == solvers.UNSERVED
    catalogue.request_cancel(cancelled)
    catalogue.note_worker("old", OLD)  # which computes something else
    catalogue.note_unserved()
    assert catalogue.get(waiting).activity is None
    clock.now += 2 * solvers.PATIENCE
    catalogue.note_unserved()
    assert catalogue.get(waiting).activity == solvers.UNSERVED


def test_a_holder_counts_as_heard_of(
    catalogue: Catalogue, claim: Callable[..., object], clock: Clock
) -> None:
    job = catalogue.submit(RUN).job.id
    catalogue.note_worker("worker", OLD)
    assert claim(f"{job}-0", OLD)
    assert [block.id for block in catalogue.held_by("worker")] == [f"{job}-0"]
    clock.now += 2 * solvers.PATIENCE
    assert catalogue.workers() == {}
    catalogue.heartbeat(f"{job}-0", 1, 30)
    assert catalogue.workers() == {"worker": OLD}


def lose(catalogue: Catalogue, block: str, worker: str, clock: Clock) -> BlockState:
    claimed = catalogue.claim_block(block, worker, 30)
    assert claimed is not None
    catalogue.reap(3, [worker])
    return catalogue.blocks(claimed.job.id)[0].state


BAD, GOOD = "bad:{}:1:boot-1:9", "good:{}:1:boot-2:9"


def test_one_machine_alone_ends_no_job_that_another_could_compute(
    catalogue: Catalogue, clock: Clock
) -> None:
    catalogue.note_worker(GOOD.format(1), OLD)
    block = f"{catalogue.submit(RUN).job.id}-0"
    states = [lose(catalogue, block, BAD.format(number), clock) for number in range(5)]
    assert states == [BlockState.queued] * 5
    clock.now += 1.0
    assert catalogue.due_wake_ups(10) == ()  # not at once, to the same machine


def test_losses_of_one_machine_are_not_those_of_all_once_each_has_lost(
    catalogue: Catalogue, clock: Clock
) -> None:
    for name in (GOOD, BAD):
        catalogue.note_worker(name.format(1), OLD)
    block = f"{catalogue.submit(RUN).job.id}-0"
    names = [GOOD, BAD, BAD, BAD, BAD, GOOD, GOOD]
    states = [
        lose(catalogue, block, name.format(number), clock) for number, name in enumerate(names)
    ]
    assert states == [BlockState.queued] * 6 + [BlockState.failed]


def test_losses_of_several_machines_end_a_job(catalogue: Catalogue, clock: Clock) -> None:
    catalogue.note_worker(GOOD.format(1), OLD)
    block = f"{catalogue.submit(RUN).job.id}-0"
    names = ["a:1:1:boot-a:9", BAD.format(1), "c:1:1:boot-c:9"]
    states = [lose(catalogue, block, name, clock) for name in names]
    assert states == [BlockState.queued] * 2 + [BlockState.failed]


def test_losses_of_the_only_machine_end_a_job(catalogue: Catalogue, clock: Clock) -> None:
    block = f"{catalogue.submit(RUN).job.id}-0"
    catalogue.note_worker(BAD.format(9), OLD)
    states = [lose(catalogue, block, BAD.format(number), clock) for number in range(3)]
    assert states == [BlockState.queued] * 2 + [BlockState.failed]


def test_a_worker_of_a_key_cannot_lose_blocks_in_the_name_of_another_machine(
    catalogue: Catalogue, clock: Clock
) -> None:
    catalogue.note_worker(GOOD.format(1), OLD)
    block = f"{catalogue.submit(RUN).job.id}-0"
    states = [lose(catalogue, block, f"key@{GOOD.format(n)}", clock) for n in range(5)]
    assert states == [BlockState.queued] * 5


def test_a_job_that_came_alone_is_taken_before_studies_and_batches(catalogue: Catalogue) -> None:
    study = catalogue.submit(STUDY).job.id
    batch = catalogue.submit_batch([RUN] * 2).jobs
    alone = catalogue.submit(RUN).job.id
    claims = [catalogue.claim_next("worker", 30, OLD) for _ in range(5)]
    expected = [f"{alone}-0", f"{study}-0", f"{study}-1", f"{batch[0]}-0", f"{batch[1]}-0"]
    assert [claim and claim.block.id for claim in claims] == expected
