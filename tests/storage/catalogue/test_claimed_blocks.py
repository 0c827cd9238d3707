"""Blocks of jobs: claimed by one worker at a time, lost, given back, sealed last."""

import itertools
import threading
from collections import Counter
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import pytest
from stepped_clock import Clock

from jointplay.records.job import JobError
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import Fenced
from jointplay.storage.catalogue.records import BlockEnd, BlockState, JobState, NewJob

NEW = NewJob("simulate", {"duration": 2.0, "scene": {"preset": "press"}}, "d" * 64, "0.1.0+abc")


def test_a_block_is_claimed_once_however_many_want_it(new_url: Callable[[], str]) -> None:
    url = new_url()
    catalogues = [Catalogue(url) for _ in range(4)]  # four processes' worth of connections
    blocks = [f"{catalogues[0].submit(NEW).job.id}-0" for _ in range(25)]
    start = threading.Barrier(len(catalogues))

    def claim_all(catalogue: Catalogue) -> list[str]:
        start.wait()
        return [block for block in blocks if catalogue.claim_block(block, "worker", 30)]

    with ThreadPoolExecutor(len(catalogues)) as pool:
        claimed = Counter(itertools.chain.from_iterable(pool.map(claim_all, catalogues)))
    assert claimed == Counter(blocks)
    for catalogue in catalogues:
        catalogue.close()


def test_a_fenced_worker_changes_nothing(catalogue: Catalogue, clock: Clock) -> None:
    job = catalogue.submit(NEW).job.id
    block = f"{job}-0"
    assert catalogue.claim_block(block, "first", 30)
    catalogue.record_checkpoint(block, 1, watermark=100, checkpoint="block0-a1")
    clock.now += 31
    assert catalogue.reap(3).requeued == (block,)
    second = catalogue.claim_block(block, "second", 30)
    assert second is not None
    assert (second.block.checkpoint, second.block.watermark) == ("block0-a1", 100)
    before = catalogue.get(job), catalogue.blocks(job), catalogue.events(job)
    for act in (
        lambda: catalogue.heartbeat(block, 1, 30),
        lambda: catalogue.record_progress(block, 1, 30, time=9, fraction=0.9),
        lambda: catalogue.record_checkpoint(block, 1, watermark=9, checkpoint="late"),
        lambda: catalogue.release(block, 1),
        lambda: catalogue.verdict(block, 1),
        lambda: catalogue.finish(block, 1, BlockEnd(BlockState.done)),
    ):
        with pytest.raises(Fenced, match="attempt 1 does not hold"):
            act()
    assert (catalogue.get(job), catalogue.blocks(job), catalogue.events(job)) == before
    assert catalogue.finish(block, 2, BlockEnd(BlockState.done)) is JobState.succeeded
    assert [attempt.outcome for attempt in catalogue.attempts(job)] == ["lost", "done"]


def test_a_block_that_keeps_losing_workers_fails_as_the_platforms_fault(
    catalogue: Catalogue, clock: Clock
) -> None:
    job = catalogue.submit(NEW).job.id
    for _ in range(3):
        assert catalogue.claim_block(f"{job}-0", "worker", 30)
        clock.now += 31
        reaped = catalogue.reap(3)
    assert reaped.ended == (job,)
    failed = catalogue.get(job)
    assert failed.state is JobState.failed
    assert failed.error is not None
    assert (failed.error.error_class, failed.error.code) == ("platform", "worker-lost")
    assert catalogue.claim_block(f"{job}-0", "worker", 30) is None


def test_giving_a_block_back_is_no_loss(catalogue: Catalogue) -> None:
    job = catalogue.submit(NEW).job.id
    for _ in range(5):
        claim = catalogue.claim_block(f"{job}-0", "worker", 30)
        assert claim is not None
        catalogue.release(f"{job}-0", claim.block.attempt)
    assert catalogue.blocks(job)[0].losses == 0
    assert [wake_up.queue for wake_up in catalogue.due_wake_ups(10)] == ["recovered"]


def test_recovered_blocks_are_told_first_and_unheard_wake_ups_repeat(
    catalogue: Catalogue, clock: Clock
) -> None:
    old = catalogue.submit(NEW).job.id
    assert catalogue.claim_block(f"{old}-0", "worker", 30)
    fresh = catalogue.submit(NEW).job.id
    clock.now += 31
    catalogue.reap(3)
    due = catalogue.due_wake_ups(10)
    assert [wake_up.block for wake_up in due] == [f"{old}-0", f"{fresh}-0"]
    catalogue.mark_published((f"{fresh}-0",), republish_after=20)
    assert [wake_up.block for wake_up in catalogue.due_wake_ups(10)] == [f"{old}-0"]
    clock.now += 20
    assert len(catalogue.due_wake_ups(10)) == 2
    catalogue.mark_published((f"{fresh}-0",), republish_after=20)
    clock.now += 20
    assert [wake_up.block for wake_up in catalogue.due_wake_ups(10)] == [f"{old}-0"]


def test_progress_of_a_job_weighs_its_blocks(catalogue: Catalogue) -> None:
    job = catalogue.submit(replace(NEW, blocks=((0, 30), (30, 10)))).job.id
    for index in (0, 1):
        assert catalogue.claim_block(f"{job}-{index}", "worker", 30)
    catalogue.record_progress(f"{job}-0", 1, 30, time=1.0, fraction=0.5)
    catalogue.record_progress(f"{job}-1", 1, 30, time=0.5, fraction=0.25)
    progressed = catalogue.get(job)
    assert progressed.progress_fraction == pytest.approx((30 * 0.5 + 10 * 0.25) / 40)
    assert progressed.progress_time == 1.0
    assert catalogue.finish(f"{job}-0", 1, BlockEnd(BlockState.done)) is JobState.running
    assert catalogue.finish(f"{job}-1", 1, BlockEnd(BlockState.done)) is JobState.succeeded
    assert catalogue.get(job).progress_fraction == 1.0


def test_the_block_that_seals_waits_for_all_others_and_goes_ahead_of_new_jobs(
    catalogue: Catalogue, clock: Clock
) -> None:
    job = catalogue.submit(replace(NEW, blocks=((0, 16), (16, 8)), seal=True)).job.id
    last = catalogue.blocks(job)[-1]
    assert (last.index, last.first, last.count, last.state) == (2, 24, 0, BlockState.waiting)
    other = catalogue.submit(NEW).job.id
    assert len(catalogue.due_wake_ups(10)) == 3
    assert catalogue.claim_block(f"{job}-2", "worker", 30) is None
    for index in (1, 0):
        assert catalogue.claim_block(f"{job}-{index}", "worker", 30)
        assert catalogue.finish(f"{job}-{index}", 1, BlockEnd(BlockState.done)) is JobState.running
    assert catalogue.get(job).progress_fraction == 1.0
    assert [wake_up.block for wake_up in catalogue.due_wake_ups(10)] == [f"{job}-2", f"{other}-0"]
    assert catalogue.claim_block(f"{job}-2", "worker", 30)
    clock.now += 31
    assert catalogue.reap(3).requeued == (f"{job}-2",)  # sealing may be interrupted
    assert catalogue.claim_block(f"{job}-2", "worker", 30)
    assert catalogue.finish(f"{job}-2", 2, BlockEnd(BlockState.done)) is JobState.succeeded


@pytest.mark.parametrize("how", ["cancel", "fail"])
def test_nothing_is_sealed_of_a_job_that_ended_otherwise(catalogue: Catalogue, how: str) -> None:
    job = catalogue.submit(replace(NEW, blocks=((0, 8), (8, 8)), seal=True)).job.id
    assert catalogue.claim_block(f"{job}-0", "worker", 30)
    if how == "cancel":
        assert catalogue.request_cancel(job).state is JobState.cancelling
        ended = catalogue.finish(f"{job}-0", 1, BlockEnd(BlockState.cancelled))
    else:
        error = JobError("platform", "storage", "the disk is full")
        ended = catalogue.finish(f"{job}-0", 1, BlockEnd(BlockState.failed, error))
    assert ended is (JobState.cancelled if how == "cancel" else JobState.failed)
    states = [block.state for block in catalogue.blocks(job)]
    assert states[1:] == [BlockState.cancelled, BlockState.cancelled]
    assert catalogue.due_wake_ups(10) == ()


def test_what_a_job_is_busy_with_shows_until_it_advances(catalogue: Catalogue) -> None:
    job = catalogue.submit(NEW).job.id
    block = f"{job}-0"
    assert catalogue.get(job).activity is None
    catalogue.claim_block(block, "worker", 30)
    catalogue.note_activity(block, 1, "compiling")
    assert catalogue.get(job).activity == "compiling"
    event = catalogue.events(job)[-1]
    assert (event.type, event.data) == ("compiling", {"block": block, "attempt": 1})
    catalogue.record_progress(block, 1, 30, time=0.1, fraction=0.1)
    assert catalogue.get(job).activity is None
    catalogue.note_activity(block, 1, "compiling")
    catalogue.release(block, 1)
    assert catalogue.get(job).activity is None
    with pytest.raises(Fenced):
        catalogue.note_activity(block, 1, "compiling")
