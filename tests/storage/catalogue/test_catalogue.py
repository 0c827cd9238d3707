import sqlite3
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

import pytest
from stepped_clock import Clock

from jointplay.records.job import JobError
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import JobNotFound, KeyReused
from jointplay.storage.catalogue.identifiers import Identifiers
from jointplay.storage.catalogue.listing import LONGEST_PAGE
from jointplay.storage.catalogue.records import (
    BlockEnd,
    BlockState,
    JobState,
    NewJob,
    SubmissionKey,
)

NEW = NewJob("simulate", {"duration": 2.0, "scene": {"preset": "press"}}, "d" * 64, "0.1.0+abc")


def test_a_job_comes_back_as_it_was_submitted(catalogue: Catalogue, clock: Clock) -> None:
    new = replace(NEW, label="Größe 1", batch="B" * 26, expires=clock.now + 5)
    submitted = catalogue.submit(new)
    job = catalogue.get(submitted.job.id)
    assert submitted.created
    assert job == submitted.job
    assert (job.spec, job.digest, job.label) == (NEW.spec, NEW.digest, "Größe 1")
    assert (job.batch, job.expires, job.created) == ("B" * 26, clock.now + 5, clock.now)
    assert (job.state, job.attempt, job.started, job.error) == (JobState.queued, 0, None, None)


def test_an_unknown_job_is_named(catalogue: Catalogue) -> None:
    with pytest.raises(JobNotFound, match="nobody"):
        catalogue.get("nobody")
    with pytest.raises(JobNotFound, match="nobody"):
        catalogue.request_cancel("nobody")


def test_pages_follow_each_other_while_jobs_arrive(catalogue: Catalogue, clock: Clock) -> None:
    first = []
    for _ in range(7):
        clock.now += 0.001
        first.append(catalogue.submit(NEW).job.id)
    page = catalogue.jobs(limit=3)
    seen = [job.id for job in page.jobs]
    catalogue.submit(NEW)  # belongs before the first page: later pages must not shift
    while page.next is not None:
        page = catalogue.jobs(limit=3, after=page.next)
        seen += [job.id for job in page.jobs]
    assert seen == first[::-1]


def test_pages_of_long_documents_have_fewer_jobs(catalogue: Catalogue, clock: Clock) -> None:
    spec = {"points": "x" * (LONGEST_PAGE // 2 - 100)}
    longer = {"points": "x" * (2 * LONGEST_PAGE)}
    made = []
    for one in (spec, spec, spec, longer, spec):
        clock.now += 0.001
        made.append(catalogue.submit(replace(NEW, spec=one)).job.id)
    page, pages = catalogue.jobs(limit=1000), []
    while True:
        pages.append([job.id for job in page.jobs])
        if page.next is None:
            break
        page = catalogue.jobs(limit=1000, after=page.next)
    a, b, c, d, e = made
    assert pages == [[e], [d], [c, b], [a]]


def test_lists_are_filtered(catalogue: Catalogue) -> None:
    wanted = catalogue.submit(replace(NEW, label="a")).job
    other = catalogue.submit(replace(NEW, kind="sweep", label="b")).job
    catalogue.request_cancel(other.id)
    assert [job.id for job in catalogue.jobs(label="a").jobs] == [wanted.id]
    assert [job.id for job in catalogue.jobs(kind="sweep").jobs] == [other.id]
    assert [job.id for job in catalogue.jobs(state=JobState.queued).jobs] == [wanted.id]
    assert catalogue.jobs(kind="sweep", state=JobState.queued).jobs == ()


@pytest.mark.parametrize("limit", [0, -1, 1001])
def test_a_page_is_bounded(catalogue: Catalogue, limit: int) -> None:
    with pytest.raises(ValueError, match="1 to 1000"):
        catalogue.jobs(limit=limit)


def test_a_key_finds_the_earlier_job_until_it_is_forgotten(
    catalogue: Catalogue, clock: Clock
) -> None:
    key = SubmissionKey("key", "fingerprint", seconds=10)
    first = catalogue.submit(NEW, key)
    assert catalogue.submit(NEW, key).job.id == first.job.id
    with pytest.raises(KeyReused, match="use a new key"):
        catalogue.submit(NEW, replace(key, fingerprint="other"))
    clock.now += 11
    assert catalogue.submit(NEW, replace(key, fingerprint="other")).created


def test_one_key_sent_at_once_by_many_makes_one_job(catalogue: Catalogue) -> None:
    key = SubmissionKey("key", "fingerprint")
    with ThreadPoolExecutor(8) as pool:
        answers = list(pool.map(lambda _: catalogue.submit(NEW, key), range(16)))
    assert sum(answer.created for answer in answers) == 1
    assert len({answer.job.id for answer in answers}) == 1


def test_an_error_is_kept_word_for_word(catalogue: Catalogue, clock: Clock) -> None:
    job = catalogue.submit(NEW).job.id
    catalogue.claim_block(f"{job}-0", "worker", 30)
    error = JobError("solver", "step-size-underflow", "h = 1e-17 s at 0.3 s", 0.3)
    clock.now += 2
    assert (
        catalogue.finish(f"{job}-0", 1, BlockEnd(BlockState.failed, error, time=0.3))
        is JobState.failed
    )
    failed = catalogue.get(job)
    assert failed.error == error
    assert failed.progress_time == 0.3
    assert failed.finished == clock.now
    assert catalogue.events(job)[-1].data["error"]["detail"] == error.detail
    assert catalogue.events(job, after=2, limit=1)[0].seq == 3


def test_a_duty_has_one_holder_at_a_time(catalogue: Catalogue, clock: Clock) -> None:
    assert catalogue.take_lead("relay", "a", 5)
    assert not catalogue.take_lead("relay", "b", 5)
    assert catalogue.take_lead("relay", "a", 5)
    clock.now += 5
    assert catalogue.take_lead("relay", "b", 5)
    catalogue.release_lead("relay", "a")  # not its own any more
    assert not catalogue.take_lead("relay", "a", 5)
    catalogue.release_lead("relay", "b")
    assert catalogue.take_lead("relay", "a", 5)


def test_ids_sort_by_time_also_within_a_millisecond_and_when_the_clock_steps_back() -> None:
    identifiers = Identifiers()
    moments = [5.0, 5.0, 5.0004, 5.002, 4.0, 6.0]
    ids = [identifiers.next(moment) for moment in moments]
    assert ids == sorted(set(ids))
    assert {len(identifier) for identifier in ids} == {26}


def test_what_was_accepted_is_durable_and_progress_is_cheap_in_sqlite(
    new_file: Callable[[], str],
) -> None:
    catalogue = Catalogue(new_file())
    modes = {}
    for durable in (True, False):
        with catalogue.connections.writing(durable=durable) as connection:
            modes[durable] = connection.exec_driver_sql("PRAGMA synchronous").scalar_one()
    assert modes == {True: 2, False: 1}  # FULL, NORMAL
    catalogue.close()


def test_a_database_that_is_no_file_is_refused() -> None:
    with pytest.raises(ValueError, match="needs a file"):
        Catalogue("sqlite://")


def test_a_reader_is_not_held_up_by_a_writer(catalogue: Catalogue) -> None:
    job = catalogue.submit(NEW).job.id
    with catalogue.connections.writing():
        assert catalogue.get(job).id == job


def test_a_busy_file_is_waited_for_in_sqlite(new_file: Callable[[], str], clock: Clock) -> None:
    url = new_file()
    catalogue = Catalogue(url, clock=clock)
    other = sqlite3.connect(Path(url.removeprefix("sqlite:///")), isolation_level=None)
    other.execute("BEGIN IMMEDIATE")
    with ThreadPoolExecutor(1) as pool:
        submitted = pool.submit(catalogue.submit, NEW)
        with pytest.raises(TimeoutError):
            submitted.result(timeout=0.2)
        other.execute("COMMIT")
        assert submitted.result(timeout=20).created
    other.close()
    catalogue.close()
