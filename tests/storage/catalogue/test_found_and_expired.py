"""Jobs that are found again, by what they ask for or by filters, and jobs that expire."""

from collections.abc import Callable
from contextlib import closing
from dataclasses import replace

import pytest
from sqlalchemy import update
from stepped_clock import Clock

from jointplay.records.job import JobError
from jointplay.storage.catalogue import labels, tables
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import JobNotFinished
from jointplay.storage.catalogue.records import BlockEnd, BlockState, NewJob, SubmissionKey

DAY = 86_400.0
NEW = NewJob("simulate", {"duration": 2.0, "scene": {"preset": "press"}}, "d" * 64, "0.1.0+abc")


def succeed(catalogue: Catalogue, new: NewJob) -> str:
    job = catalogue.submit(new).job.id
    catalogue.claim_block(f"{job}-0", "worker", 30)
    catalogue.finish(f"{job}-0", 1, BlockEnd(BlockState.done, steps=1000))
    return job


def test_an_identical_job_is_found_and_not_made_again(catalogue: Catalogue) -> None:
    first = catalogue.submit(NEW, reuse=True)
    again = catalogue.submit(replace(NEW, label="mine"), reuse=True)
    assert (first.created, first.cached) == (True, False)
    assert (again.created, again.cached, again.job.id) == (False, True, first.job.id)
    assert again.job.label == catalogue.get(first.job.id).label == "mine"  # it had none
    named = catalogue.submit(replace(NEW, label="other"), reuse=True)
    assert (named.cached, named.job.label) == (True, "mine")
    for other in (
        replace(NEW, digest="e" * 64),
        replace(NEW, solver_version="0.1.0+def"),
    ):
        assert catalogue.submit(other, reuse=True).created
    assert catalogue.submit(NEW).created


def test_what_ended_badly_or_is_being_cancelled_is_not_found_again(catalogue: Catalogue) -> None:
    queued = catalogue.submit(NEW).job.id
    catalogue.request_cancel(queued)
    cancelling = catalogue.submit(NEW, reuse=True).job.id
    catalogue.claim_block(f"{cancelling}-0", "worker", 30)
    catalogue.request_cancel(cancelling)
    failed = catalogue.submit(NEW, reuse=True).job.id
    catalogue.claim_block(f"{failed}-0", "worker", 30)
    assert catalogue.submit(NEW, reuse=True).job.id == failed  # it is running
    error = JobError("solver", "step-size-underflow", "The step fell below 1e-15 s.")
    catalogue.finish(f"{failed}-0", 1, BlockEnd(BlockState.failed, error))
    assert len({queued, cancelling, failed, catalogue.submit(NEW, reuse=True).job.id}) == 4


def test_a_job_that_is_deleted_while_it_is_asked_for_again_stays_deleted(
    new_url: Callable[[], str], clock: Clock
) -> None:
    url = new_url()
    with closing(Catalogue(url, clock=clock)) as other:
        job = succeed(other, NEW)

        def deleting() -> float:
            """Tell the time, after which the job is deleted before anything else is done."""
            now = clock.now
            if not other.expired(other.get(job)):
                clock.now += 1.0
                other.delete(job)
            return now

        with closing(Catalogue(url, clock=deleting)) as catalogue:
            found = catalogue.submit(NEW, reuse=True)
        assert (found.created, found.cached) == (True, False)
        assert other.expired(other.get(job))
        assert other.submit(NEW, reuse=True).job.id == found.job.id


def test_a_job_that_is_wanted_again_expires_later_and_an_expired_one_is_not_found(
    catalogue: Catalogue, clock: Clock
) -> None:
    job = succeed(catalogue, replace(NEW, expires=clock.now + 5))
    again = catalogue.submit(replace(NEW, expires=clock.now + 8), reuse=True)
    assert (again.job.id, again.job.expires) == (job, clock.now + 8)
    sooner = catalogue.submit(replace(NEW, expires=clock.now + 1), reuse=True)
    assert sooner.job.expires == clock.now + 8
    clock.now += 9
    assert catalogue.expired(catalogue.get(job))
    lasting = catalogue.submit(replace(NEW, expires=clock.now + 5), reuse=True)
    assert lasting.created
    assert catalogue.submit(NEW, reuse=True).job.expires is None


@pytest.mark.parametrize(("lifetime", "kept"), [(7 * DAY, DAY), (60.0, 60.0)])
def test_a_job_that_ends_late_can_be_read_for_a_while(
    catalogue: Catalogue, clock: Clock, lifetime: float, kept: float
) -> None:
    """Its results were removed in the second in which it ended: nobody could read them."""
    job = catalogue.submit(replace(NEW, expires=clock.now + lifetime)).job.id
    clock.now += lifetime + 5.0  # it waited, or took so long
    assert catalogue.submit(replace(NEW, expires=clock.now + lifetime), reuse=True).job.id == job
    catalogue.claim_block(f"{job}-0", "worker", 30)
    with catalogue.connections.writing() as connection:  # as if nobody had asked again
        expires = update(tables.job).values(expires=clock.now - 5.0)
        connection.execute(expires.where(tables.job.c.id == job))
    catalogue.finish(f"{job}-0", 1, BlockEnd(BlockState.done))
    assert catalogue.get(job).expires == clock.now + kept
    clock.now += kept - 1.0
    assert not catalogue.expired(catalogue.get(job))
    clock.now += 1.0
    assert catalogue.removable(10) == (job,)


def test_a_job_that_ends_in_time_expires_when_it_was_to(catalogue: Catalogue, clock: Clock) -> None:
    expires = clock.now + 7 * DAY
    job = succeed(catalogue, replace(NEW, expires=expires))
    assert catalogue.get(job).expires == expires
    assert catalogue.get(succeed(catalogue, NEW)).expires is None


def test_a_lifetime_is_what_was_asked_for_however_late_a_job_is_found_or_ends(
    catalogue: Catalogue, clock: Clock
) -> None:
    """A retry is kept for as long: it was, too, for as long as its job had waited."""
    job = catalogue.submit(replace(NEW, expires=clock.now + 5 * DAY)).job.id
    assert catalogue.get(job).lifetime == 5 * DAY
    clock.now += 4 * DAY
    for asked, kept in ((3 * DAY, 5 * DAY), (6 * DAY, 6 * DAY)):
        found = catalogue.submit(replace(NEW, expires=clock.now + asked), reuse=True).job
        assert (found.id, found.expires) == (job, clock.now + asked)
        assert found.lifetime == catalogue.get(job).lifetime == kept
    clock.now += 20 * DAY
    catalogue.claim_block(f"{job}-0", "worker", 30)
    catalogue.finish(f"{job}-0", 1, BlockEnd(BlockState.done))
    ended = catalogue.get(job)
    assert (ended.expires, ended.lifetime) == (clock.now + DAY, 6 * DAY)
    with catalogue.connections.writing() as connection:  # as of before lifetimes were noted
        connection.execute(update(tables.job).values(kept_for=None))
    assert catalogue.get(job).lifetime == 25 * DAY
    lasting = catalogue.submit(NEW, reuse=True).job
    assert (lasting.id, lasting.lifetime) == (job, None)


def test_a_key_remembers_whether_it_was_answered_with_an_earlier_job(
    catalogue: Catalogue, clock: Clock
) -> None:
    made, found = (SubmissionKey(name, "f" * 64) for name in ("made", "found"))
    first = catalogue.submit(NEW, made, reuse=True)
    clock.now += 1
    assert catalogue.submit(NEW, found, reuse=True).cached
    again = [catalogue.submit(NEW, key, reuse=True) for key in (made, found)]
    assert [one.job.id for one in again] == [first.job.id] * 2
    assert [one.cached for one in again] == [False, True]


def test_a_deleted_job_expires_and_its_results_are_to_be_removed_once(
    catalogue: Catalogue, clock: Clock
) -> None:
    job = succeed(catalogue, NEW)
    queued = catalogue.submit(replace(NEW, expires=clock.now)).job.id
    assert catalogue.removable(10) == ()
    assert catalogue.delete(job).expires == clock.now
    assert catalogue.delete(job).expires == clock.now
    with pytest.raises(JobNotFinished, match="cancel it"):
        catalogue.delete(queued)
    assert not catalogue.expired(catalogue.get(queued))  # what is live does not expire
    assert [one.id for one in catalogue.jobs().jobs] == [queued]
    assert catalogue.removable(10) == (job,)
    catalogue.mark_removed([job])
    assert catalogue.removable(10) == ()
    assert catalogue.get(job).removed == clock.now


def test_jobs_are_found_by_scene_and_by_the_time_of_their_submission(
    catalogue: Catalogue, clock: Clock
) -> None:
    made = []
    for scene in ("press", "pendulum", "press"):
        made.append(catalogue.submit(replace(NEW, scene=scene)).job)
        clock.now += 1
    first, second, third = (job.id for job in made)
    assert [job.id for job in catalogue.jobs(scene="press").jobs] == [third, first]
    assert [job.id for job in catalogue.jobs(since=made[1].created).jobs] == [third, second]
    assert [job.id for job in catalogue.jobs(before=made[1].created).jobs] == [first]
    window = catalogue.jobs(since=made[0].created, before=made[2].created, scene="pendulum")
    assert [job.id for job in window.jobs] == [second]


def test_a_status_shows_how_far_a_job_is(catalogue: Catalogue) -> None:
    job = catalogue.submit(replace(NEW, blocks=((0, 1), (1, 1)))).job.id
    for index in (0, 1):
        catalogue.claim_block(f"{job}-{index}", "worker", 30)
        catalogue.record_progress(f"{job}-{index}", 1, 30, time=1.0, fraction=0.5, steps=300)
    (status,) = catalogue.statuses([job, "nobody"])
    assert (status.state, status.time, status.fraction, status.steps) == ("running", 1.0, 0.5, 600)
    assert status.last_event == catalogue.events(job)[-1].seq
    assert catalogue.get(job).steps == 600


def test_a_job_is_found_by_every_label_that_it_was_asked_for_with(catalogue: Catalogue) -> None:
    first = catalogue.submit(replace(NEW, label="a"), reuse=True).job
    assert first.further_labels is None
    for label in ("c", "b", "a", "b", None):
        found = catalogue.submit(replace(NEW, label=label), reuse=True)
        assert (found.job.id, found.cached) == (first.id, True)
    assert (found.job.label, found.job.further_labels) == ("a", ("b", "c"))
    other = catalogue.submit(replace(NEW, label="b"), reuse=False).job
    assert [job.id for job in catalogue.jobs(label="b").jobs] == [other.id, first.id]
    for label in "ac":
        (job,) = catalogue.jobs(label=label).jobs
        assert job == catalogue.get(first.id) == found.job
    assert catalogue.jobs(label="d").jobs == ()


def test_every_answer_about_a_job_has_its_further_labels(catalogue: Catalogue) -> None:
    key = SubmissionKey("key", "fingerprint")
    first = catalogue.submit(replace(NEW, label="a"), key).job
    catalogue.submit(replace(NEW, label="b"), reuse=True)
    again = catalogue.submit(replace(NEW, label="a"), key)
    cancelled = [catalogue.request_cancel(first.id) for _ in range(2)]
    deleted = catalogue.delete(first.id)
    for job in (again.job, *cancelled, deleted):
        assert (job.id, job.further_labels) == (first.id, ("b",))


def test_further_labels_are_bounded(catalogue: Catalogue, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(labels, "MOST", 2)
    for label in "abcd":
        found = catalogue.submit(replace(NEW, label=label), reuse=True)
    assert found.job.further_labels == ("b", "c")


@pytest.mark.parametrize("mark", [False, True])
def test_a_key_finds_no_job_that_was_deleted(
    catalogue: Catalogue, clock: Clock, mark: bool
) -> None:
    """As it finds no batch: the same request makes a new one."""
    new, key = NewJob("simulate", {}, "f" * 64, "1"), SubmissionKey("k", "fingerprint")
    first = catalogue.submit(new, key).job.id
    catalogue.claim_block(f"{first}-0", "worker", 30.0)
    catalogue.finish(f"{first}-0", 1, BlockEnd(BlockState.done))
    assert catalogue.submit(new, key).job.id == first
    catalogue.delete(first)
    clock.now += 1
    if mark:
        catalogue.mark_removed(catalogue.removable(10))
    assert catalogue.submitted_job(key) is None
    second = catalogue.submit(new, key)
    assert (second.created, second.job.id != first) == (True, True)
    assert catalogue.submit(new, key).job.id == second.job.id
