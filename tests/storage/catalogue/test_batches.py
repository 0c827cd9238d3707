import sqlite3
from collections.abc import Callable
from dataclasses import replace

import pytest
from sqlalchemy.exc import IntegrityError
from stepped_clock import Clock

from jointplay.records.job import JobError
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import (
    BatchNotFinished,
    BatchNotFound,
    KeyReused,
    RetriedMeanwhile,
)
from jointplay.storage.catalogue.records import (
    BlockEnd,
    BlockState,
    JobState,
    NewJob,
    SubmissionKey,
)

NEW = NewJob("simulate", {"duration": 2.0}, "d" * 64, "0.1.0+abc")
STUDY = replace(NEW, kind="sweep", blocks=((0, 8), (8, 8)), seal=True)


def test_a_batch_is_listed_in_the_order_of_its_jobs(catalogue: Catalogue, clock: Clock) -> None:
    other = catalogue.submit(NEW).job.id
    jobs = [replace(NEW, label=str(index)) for index in range(7)]
    submitted = catalogue.submit_batch(jobs, label="clearances")
    batch = submitted.batch
    assert submitted.created
    assert (batch.label, batch.created) == ("clearances", clock.now)
    assert (batch.count, batch.states[JobState.queued], batch.fraction) == (7, 7, 0.0)
    page = catalogue.jobs(batch=batch.id, oldest_first=True, limit=4)
    seen = list(page.jobs)
    page = catalogue.jobs(batch=batch.id, oldest_first=True, limit=4, after=page.next)
    seen += page.jobs
    assert page.next is None
    assert [job.label for job in seen] == [str(index) for index in range(7)]
    assert tuple(job.id for job in seen) == submitted.jobs
    assert {job.batch for job in seen} == {batch.id}
    assert other not in submitted.jobs
    assert len(catalogue.due_wake_ups(100)) == 8


def test_progress_of_the_whole(catalogue: Catalogue) -> None:
    submitted = catalogue.submit_batch([NEW, NEW, NEW, STUDY])
    done, failed, running, study = submitted.jobs
    for job in submitted.jobs:
        assert catalogue.claim_block(f"{job}-0", "worker", 30)
    catalogue.finish(f"{done}-0", 1, BlockEnd(BlockState.done))
    error = JobError("solver", "step-size-underflow", "why", 0.5)
    catalogue.finish(f"{failed}-0", 1, BlockEnd(BlockState.failed, error, fraction=0.1))
    catalogue.record_progress(f"{running}-0", 1, 30, time=0.1, fraction=0.5)
    catalogue.record_progress(f"{study}-0", 1, 30, time=0.1, fraction=0.5)
    batch = catalogue.batch(submitted.batch.id)
    assert {state.value: count for state, count in batch.states.items() if count} == {
        "running": 2,
        "succeeded": 1,
        "failed": 1,
    }
    assert batch.fraction == pytest.approx((1 + 1 + 0.5 + 0.25) / 4)
    assert not batch.finished
    catalogue.finish(f"{running}-0", 1, BlockEnd(BlockState.done))
    catalogue.request_cancel(study)
    catalogue.finish(f"{study}-0", 1, BlockEnd(BlockState.cancelled))
    batch = catalogue.batch(submitted.batch.id)
    assert batch.finished
    assert batch.fraction == 1.0


def test_all_or_nothing(catalogue: Catalogue) -> None:
    impossible = replace(NEW, digest=None)  # type: ignore[arg-type]
    with pytest.raises(IntegrityError):
        catalogue.submit_batch([NEW, NEW, impossible])
    assert catalogue.jobs().jobs == ()
    assert catalogue.due_wake_ups(10) == ()


@pytest.mark.parametrize("count", [0, 10_001])
def test_a_batch_is_bounded(catalogue: Catalogue, count: int) -> None:
    with pytest.raises(ValueError, match=f"1 to 10000 jobs, not {count}"):
        catalogue.submit_batch([NEW] * count)


def test_cancelling_a_batch_cancels_what_has_not_ended(catalogue: Catalogue, clock: Clock) -> None:
    outside = catalogue.submit(NEW).job.id
    submitted = catalogue.submit_batch([NEW, NEW, NEW, STUDY, STUDY, STUDY])
    done, held, queued, half_done, given_back, untouched = submitted.jobs
    for job in (done, held, half_done, given_back):
        assert catalogue.claim_block(f"{job}-0", "worker", 30)
    for job in (done, half_done):
        catalogue.finish(f"{job}-0", 1, BlockEnd(BlockState.done))
    catalogue.release(f"{given_back}-0", 1)
    clock.now += 1
    batch = catalogue.cancel_batch(submitted.batch.id)
    states = {job: catalogue.get(job).state for job in submitted.jobs}
    assert states == {
        done: JobState.succeeded,
        held: JobState.cancelling,  # a worker has it, and closes its store
        queued: JobState.cancelled,
        half_done: JobState.cancelled,
        given_back: JobState.cancelling,  # has results: a worker closes them
        untouched: JobState.cancelled,
    }
    assert batch.states[JobState.cancelled] == 3
    assert catalogue.get(queued).finished == clock.now
    assert [event.type for event in catalogue.events(untouched)] == ["queued", "cancelled"]
    assert [event.seq for event in catalogue.events(untouched)] == [1, 2]
    due = {wake_up.block for wake_up in catalogue.due_wake_ups(100)}
    assert due == {f"{outside}-0", f"{given_back}-0"}
    for job in (queued, half_done, untouched):
        assert all(
            block.state in (BlockState.done, BlockState.cancelled)
            for block in catalogue.blocks(job)
        )
    again = catalogue.cancel_batch(submitted.batch.id)
    assert again == batch
    assert len(catalogue.events(queued)) == 2


def test_a_key_finds_the_earlier_batch(catalogue: Catalogue, clock: Clock) -> None:
    key = SubmissionKey("key", "fingerprint", seconds=10)
    first = catalogue.submit_batch([NEW, NEW], key=key)
    again = catalogue.submit_batch([NEW, NEW], key=key)
    assert (again.batch, again.jobs, again.created) == (first.batch, first.jobs, False)
    with pytest.raises(KeyReused):
        catalogue.submit_batch([NEW], key=replace(key, fingerprint="other"))
    with pytest.raises(KeyReused):
        catalogue.submit(NEW, replace(key, fingerprint="other"))
    clock.now += 11
    assert catalogue.submit_batch([NEW], key=key).created
    assert len(catalogue.jobs().jobs) == 3


def test_an_unknown_batch_is_named(catalogue: Catalogue) -> None:
    with pytest.raises(BatchNotFound, match="nothing"):
        catalogue.batch("nothing")
    with pytest.raises(BatchNotFound, match="nothing"):
        catalogue.cancel_batch("nothing")


def test_what_to_publish_and_how_far_a_batch_is_are_found_by_index_in_sqlite(
    new_file: Callable[[], str],
) -> None:
    """However many wait: a scan or a sort of 100 000 rows twice a second would be felt."""
    statements: list[str] = []
    catalogue = Catalogue(new_file())
    connection = catalogue.connections
    batch = catalogue.submit_batch([NEW] * 3).batch.id
    with connection.reading() as reading:
        raw = reading.connection.driver_connection
        assert isinstance(raw, sqlite3.Connection)
    raw.set_trace_callback(statements.append)
    catalogue.due_wake_ups(10)
    catalogue.batch(batch)
    raw.set_trace_callback(None)
    selects = [s for s in statements if s.startswith("SELECT")]
    assert len(selects) == 6
    plans = [row[-1] for s in selects for row in raw.execute(f"EXPLAIN QUERY PLAN {s}")]
    assert not any("SCAN" in plan or "TEMP B-TREE" in plan for plan in plans), plans
    assert sum("USING COVERING INDEX" in plan for plan in plans) >= 4, plans
    catalogue.close()


def ended(catalogue: Catalogue, job: str, outcome: BlockState) -> None:
    assert catalogue.claim_block(f"{job}-0", "worker", 30)
    error = JobError("solver", "step-size-underflow", "why") if outcome == "failed" else None
    catalogue.finish(f"{job}-0", 1, BlockEnd(outcome, error))


def test_a_batch_is_deleted_with_its_jobs_once_all_have_ended(
    catalogue: Catalogue, clock: Clock
) -> None:
    key = SubmissionKey("k", "f" * 64)
    other = catalogue.submit_batch([NEW]).batch.id
    submitted = catalogue.submit_batch([NEW] * 3, key=key)
    batch, (done, failed, waiting) = submitted.batch.id, submitted.jobs
    ended(catalogue, done, BlockState.done)
    ended(catalogue, failed, BlockState.failed)
    with pytest.raises(BatchNotFinished, match="1 job has not ended"):
        catalogue.delete_batch(batch)
    assert not catalogue.expired(catalogue.get(done))
    catalogue.request_cancel(waiting)
    assert catalogue.delete_batch(batch).id == batch
    assert all(catalogue.expired(catalogue.get(job)) for job in submitted.jobs)
    assert set(catalogue.removable(10)) == set(submitted.jobs)
    with pytest.raises(BatchNotFound):
        catalogue.delete_batch(batch)
    assert [one.id for one in catalogue.page_of_batches()[0]] == [other]
    again = catalogue.submit_batch([NEW] * 3, key=key)
    assert again.created, "its key does not lead to a batch that is gone"


def test_what_a_key_was_answered_with_is_found_without_the_jobs(
    catalogue: Catalogue, clock: Clock
) -> None:
    key = SubmissionKey("k", "f" * 64)
    assert catalogue.submitted_batch(key) is None
    made = catalogue.submit_batch([NEW] * 2, key=key)
    assert catalogue.submitted_batch(key) == replace(made, created=False)
    with pytest.raises(KeyReused):
        catalogue.submitted_batch(replace(key, fingerprint="0" * 64))
    clock.now += key.seconds
    assert catalogue.submitted_batch(key) is None


def test_a_retry_is_told_in_the_events_of_both_jobs(catalogue: Catalogue) -> None:
    submitted = catalogue.submit_batch([NEW] * 3)
    done, failed, cancelled = submitted.jobs
    ended(catalogue, done, BlockState.done)
    ended(catalogue, failed, BlockState.failed)
    assert [(job.id, told) for job, told in catalogue.unsuccessful(submitted.batch.id)] == [
        (failed, False)
    ]
    catalogue.request_cancel(cancelled)
    alone = catalogue.submit(replace(NEW, retry_of=failed), reuse=False).job.id
    assert [(job.id, told) for job, told in catalogue.unsuccessful(submitted.batch.id)] == [
        (failed, True),
        (cancelled, False),
    ]
    (last,) = catalogue.events(failed)[-1:]
    assert (last.type, last.data) == ("retried", {"job": alone})
    (first,) = catalogue.events(alone)
    assert (first.type, first.data) == ("queued", {"retry_of": failed})
    once_more = catalogue.submit(replace(NEW, retry_of=failed), reuse=False).job.id
    assert [event.data["job"] for event in catalogue.events(failed) if event.type == "retried"] == [
        alone,
        once_more,
    ]
    together = catalogue.submit_batch([replace(NEW, retry_of=cancelled)])
    assert catalogue.events(cancelled)[-1].data == {"job": together.jobs[0]}
    assert catalogue.get(failed).state is JobState.failed


def test_two_retries_of_a_batch_at_once_repeat_no_job_twice(catalogue: Catalogue) -> None:
    """Between what the first one saw and what it queues another job fails, and both are retried."""
    batch = catalogue.submit_batch([NEW, replace(NEW, digest="e" * 64)]).batch.id
    first, second = (job.id for job in catalogue.jobs(batch=batch, oldest_first=True).jobs)
    catalogue.request_cancel(first)
    seen = [job.id for job, retried in catalogue.unsuccessful(batch) if not retried]
    assert seen == [first]
    catalogue.request_cancel(second)
    both = [replace(NEW, retry_of=job) for job in (first, second)]
    catalogue.submit_batch(both, key=SubmissionKey("both", ""))
    with pytest.raises(RetriedMeanwhile, match=first):
        catalogue.submit_batch([replace(NEW, retry_of=first)], key=SubmissionKey("one", ""))
    assert catalogue.submitted_batch(SubmissionKey("one", "")) is None
    assert len(catalogue.page_of_batches()[0]) == 2
    told = [event.data for event in catalogue.events(first) if event.type == "retried"]
    assert len(told) == 1
    again = catalogue.submit_batch(both, key=SubmissionKey("both", ""))
    assert not again.created
