"""A clock that was set takes no block from the living, and delays nothing for long."""

from dataclasses import replace

import pytest
from stepped_clock import Clock

from jointplay.records.job import JobError
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import BlockEnd, BlockState, NewJob, SubmittedBatch

NEW = NewJob("simulate", {}, "d" * 64, "1")
LEASE, REPUBLISH_AFTER, HOUR = 30.0, 20.0, 3600.0


def test_a_lease_lasts_no_longer_than_a_lease(catalogue: Catalogue, clock: Clock) -> None:
    job = catalogue.submit(NEW).job.id
    catalogue.claim_block(f"{job}-0", "worker", LEASE)
    clock.now -= HOUR
    catalogue.mend_after_setting_back(LEASE, REPUBLISH_AFTER)
    clock.now += LEASE - 1
    assert catalogue.reap(3).requeued == ()
    clock.now += 2
    assert catalogue.reap(3).requeued == (f"{job}-0",)


def test_a_wake_up_is_sent_again_at_once(catalogue: Catalogue, clock: Clock) -> None:
    block = f"{catalogue.submit(NEW).job.id}-0"
    catalogue.mark_published((block,), REPUBLISH_AFTER)
    clock.now -= HOUR
    assert catalogue.due_wake_ups(10) == ()
    catalogue.mend_after_setting_back(LEASE, REPUBLISH_AFTER)
    assert [wake_up.block for wake_up in catalogue.due_wake_ups(10)] == [block]


def test_a_block_that_was_queued_just_before_is_announced(
    catalogue: Catalogue, clock: Clock
) -> None:
    block = f"{catalogue.submit(NEW).job.id}-0"
    clock.now -= 60.0
    assert catalogue.due_wake_ups(10) == ()
    catalogue.mend_after_setting_back(LEASE, REPUBLISH_AFTER)
    assert [wake_up.block for wake_up in catalogue.due_wake_ups(10)] == [block]
    catalogue.mark_published((block,), REPUBLISH_AFTER)
    catalogue.mend_after_setting_back(LEASE, REPUBLISH_AFTER)
    assert catalogue.due_wake_ups(10) == ()


@pytest.mark.parametrize("jump", [60.0, -60.0])
def test_a_clock_that_is_set_while_leases_are_looked_at_takes_no_block(
    catalogue: Catalogue, clock: Clock, jump: float
) -> None:
    job = catalogue.submit(NEW).job.id
    catalogue.claim_block(f"{job}-0", "worker", LEASE)
    seen = clock.now
    clock.now += jump
    if jump < 0.0:
        catalogue.heartbeat(f"{job}-0", 1, LEASE)  # by a worker that knows of it
    assert catalogue.reap(3, until=seen).requeued == ()


def test_nothing_is_mended_where_the_clock_is_right(catalogue: Catalogue, clock: Clock) -> None:
    held, sent = (catalogue.submit(NEW).job.id for _ in range(2))
    catalogue.claim_block(f"{held}-0", "worker", LEASE)
    catalogue.mark_published((f"{sent}-0",), REPUBLISH_AFTER)
    clock.now += 1
    catalogue.mend_after_setting_back(LEASE, REPUBLISH_AFTER)
    assert catalogue.blocks(held)[0].lease_until == clock.now - 1 + LEASE
    assert catalogue.due_wake_ups(10) == ()


def test_a_lead_is_not_waited_for(catalogue: Catalogue, clock: Clock) -> None:
    assert catalogue.take_lead("relay", "gone", 5)
    clock.now -= HOUR
    assert catalogue.take_lead("relay", "present", 5)
    assert not catalogue.take_lead("relay", "other", 5)


def ended_batch(catalogue: Catalogue) -> SubmittedBatch:
    """Return a batch of a job that is done, and of one that failed."""
    batch = catalogue.submit_batch([NEW, replace(NEW, digest="e" * 64)])
    for job, state in zip(batch.jobs, (BlockState.done, BlockState.failed), strict=True):
        catalogue.claim_block(f"{job}-0", "worker", LEASE)
        error = JobError("solver", "diverged", "it did") if state is BlockState.failed else None
        catalogue.finish(f"{job}-0", 1, BlockEnd(state, error))
    return batch


@pytest.mark.parametrize("removed", [True, False])
@pytest.mark.parametrize("together", [True, False])
def test_what_was_deleted_does_not_come_back(
    catalogue: Catalogue, clock: Clock, together: bool, removed: bool
) -> None:
    batch = ended_batch(catalogue)
    if together:
        catalogue.delete_batch(batch.batch.id)
    else:
        for job in batch.jobs:
            catalogue.delete(job)
    if removed:
        catalogue.mark_removed(catalogue.removable(10))
    clock.now -= HOUR
    assert all(catalogue.expired(catalogue.get(job)) for job in batch.jobs)
    assert catalogue.jobs().jobs == ()
    assert catalogue.unsuccessful(batch.batch.id) == ()
    assert catalogue.identical(NEW) is None
    again = catalogue.submit(NEW, reuse=True)
    assert (again.cached, again.job.id in batch.jobs) == (False, False)
    assert catalogue.get(batch.jobs[0]).expires == clock.now + HOUR
    assert catalogue.removable(10) == (() if removed else batch.jobs)


def test_what_expired_and_was_removed_does_not_come_back(
    catalogue: Catalogue, clock: Clock
) -> None:
    kept = catalogue.submit(replace(NEW, expires=clock.now + HOUR)).job.id
    catalogue.claim_block(f"{kept}-0", "worker", LEASE)
    catalogue.finish(f"{kept}-0", 1, BlockEnd(BlockState.done))
    clock.now += HOUR
    assert catalogue.removable(10) == (kept,)
    catalogue.mark_removed((kept,))
    clock.now -= HOUR
    assert catalogue.expired(catalogue.get(kept))
    assert catalogue.jobs().jobs == ()
