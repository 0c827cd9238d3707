"""Blocks of a study that are offered to a worker which has one of it: those that may be claimed."""

from stepped_clock import Clock

from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import NewJob

BLOCKS = tuple((4 * index, 4) for index in range(5))
STUDY = NewJob("chart", {}, "d" * 64, "1", owner="ada", blocks=BLOCKS, seal=True)


def test_a_block_that_was_put_off_is_not_offered_before_its_pause_is_over(
    catalogue: Catalogue, clock: Clock
) -> None:
    job = catalogue.submit(STUDY).job.id
    waiting = [f"{job}-{index}" for index in range(len(BLOCKS))]
    assert list(catalogue.queued_of(job, 9)) == waiting
    assert catalogue.claim_block(waiting[0], "one", 30.0)
    catalogue.put_off(waiting[0], 1, "waiting for room on the disk")
    assert list(catalogue.queued_of(job, 9)) == waiting[1:]
    clock.now += 10.0
    assert list(catalogue.queued_of(job, 2)) == waiting[:2]


def test_an_owner_has_no_more_blocks_computed_than_are_allowed(catalogue: Catalogue) -> None:
    job = catalogue.submit(STUDY).job.id
    for index in range(2):  # by any worker
        assert catalogue.claim_block(f"{job}-{index}", f"worker {index}", 30.0)
    assert list(catalogue.queued_of(job, 9, 3)) == [f"{job}-2"]
    assert list(catalogue.queued_of(job, 9, 2)) == []
