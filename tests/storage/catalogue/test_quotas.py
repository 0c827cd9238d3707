"""Quotas of owners, also where many ask for jobs at the same time."""

from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from dataclasses import replace
from itertools import islice

import pytest
from sqlalchemy import select
from stepped_clock import Clock

from jointplay.storage.catalogue import submission, tables
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.connections import Unit
from jointplay.storage.catalogue.errors import QuotaExceeded
from jointplay.storage.catalogue.quotas import Quota, Use
from jointplay.storage.catalogue.records import BlockEnd, BlockState, NewJob, SubmissionKey

NEW = NewJob("simulate", {"duration": 2.0}, "d" * 64, "0.1.0+abc", owner="ada")
MOST = 5
TWO = Quota(live=2)
HOUR = 3600.0


def jobs_of(owner: str) -> Iterator[NewJob]:
    for number in range(1000):
        yield replace(NEW, owner=owner, digest=f"{number:064}")


def test_many_at_once_do_not_exceed_it(new_url: Callable[[], str]) -> None:
    url = new_url()
    with closing(Catalogue(url)) as one, closing(Catalogue(url)) as other:

        def accepted(asked: tuple[int, NewJob]) -> int:
            number, new = asked
            through = (one, other)[number % 2]
            try:
                if number % 5:
                    through.submit(new, quota=Quota(live=MOST))
                    return 1
                through.submit_batch([new, new], owner=new.owner, quota=Quota(live=MOST))
                return 2
            except QuotaExceeded:
                return 0

        with ThreadPoolExecutor(10) as threads:
            found = list(threads.map(accepted, enumerate(islice(jobs_of("ada"), 20))))
        assert sum(found) == len(one.jobs(owner="ada").jobs)
        assert sum(found) == MOST


def test_what_makes_no_job_is_answered_at_the_limit(catalogue: Catalogue) -> None:
    key = SubmissionKey("again", "f", owner="ada")
    made = [catalogue.submit(new, quota=TWO) for new in islice(jobs_of("ada"), 1)]
    made.append(catalogue.submit(NEW, key, quota=TWO))
    assert catalogue.submit(NEW, key, quota=TWO).job.id == made[1].job.id
    assert catalogue.submit(NEW, reuse=True, quota=TWO).cached
    with pytest.raises(QuotaExceeded, match=r"ada has 2 jobs .* may have 2; this would be 1 more"):
        catalogue.submit(NEW, quota=TWO)
    with pytest.raises(QuotaExceeded, match="this would be 3 more"):
        catalogue.submit_batch([NEW] * 3, owner="ada", quota=TWO)
    catalogue.submit(replace(NEW, owner="bob"), quota=Quota(live=1))
    catalogue.submit(NEW)  # any number
    for answer in made:
        catalogue.request_cancel(answer.job.id)
    assert catalogue.submit(NEW, quota=TWO).created


def test_keys_of_one_owner_have_quotas_of_their_own(catalogue: Catalogue, clock: Clock) -> None:
    limited, free = Quota(live=1), Quota()
    asked = [
        submission.Request(new, None, False, quota)
        for new, quota in zip(jobs_of("ada"), (free, limited, free), strict=False)
    ]
    for requests in (asked, asked[::-1]):  # together, in one unit
        ids = (f"{clock.now:.0f}{number:016}" for number in range(3))
        with catalogue.connections.writing() as connection:
            unit = Unit(connection, clock.now)
            answers = submission.submit(unit, requests, ids.__next__, clock)
        assert [isinstance(answer, QuotaExceeded) for answer in answers] == [False, True, False]
        clock.now += 1.0


def test_bytes_of_results_count_from_the_end_of_a_job_until_they_are_removed(
    catalogue: Catalogue,
) -> None:
    small = Quota(stored=1000)
    first, second = (catalogue.submit(new, quota=small).job.id for new in islice(jobs_of("ada"), 2))
    nobodys = catalogue.submit(replace(NEW, owner="")).job.id
    assert catalogue.unmeasured(9) == ()
    for job in (first, second, nobodys):
        catalogue.request_cancel(job)
    assert catalogue.unmeasured(1) == (first,)
    assert catalogue.unmeasured(9) == (first, second)
    catalogue.note_stored({first: 999, second: 0})
    assert catalogue.unmeasured(9) == ()
    catalogue.submit(NEW, quota=small)
    catalogue.note_stored({second: 1})
    with pytest.raises(QuotaExceeded, match="ada has 1000 bytes of results, and may have 1000"):
        catalogue.submit(NEW, quota=small)
    with pytest.raises(QuotaExceeded, match="1000 bytes"):
        catalogue.submit_batch([NEW], owner="ada", quota=small)
    catalogue.submit(replace(NEW, owner="bob"), quota=small)
    catalogue.mark_removed([first])
    assert catalogue.use_of("ada") == Use(live=1, running=0, stored=1, computed=0.0)
    assert catalogue.submit(NEW, quota=small).created


def test_processor_time_counts_for_a_day_however_attempts_end(
    catalogue: Catalogue, clock: Clock
) -> None:
    day = Quota(computed=100.0)
    job, other = (catalogue.submit(new, quota=day).job.id for new in islice(jobs_of("ada"), 2))
    clock.now = HOUR * (clock.now // HOUR + 1)
    for worker, seconds, ended in (
        ("one", 10.0, lambda: catalogue.release(f"{job}-0", 1)),
        ("one", 20.0, lambda: catalogue.put_off(f"{job}-0", 2, "waits")),
        ("two", 40.0, lambda: catalogue.reap(9)),
        ("one", 20.0, lambda: catalogue.finish(f"{job}-0", 4, BlockEnd(BlockState.done))),
    ):
        assert catalogue.claim_block(f"{job}-0", worker, seconds - 1.0)
        clock.now += seconds
        ended()
        clock.now += 10.0
    assert catalogue.use_of("ada").computed == pytest.approx(90.0)
    assert catalogue.submit(NEW, quota=day).created
    assert catalogue.claim_block(f"{other}-0", "two", HOUR)
    clock.now += 12.0  # what runs counts as well
    with pytest.raises(QuotaExceeded, match=r"computed 0.0283 core-hours .* 0.0278 core-hours;"):
        catalogue.submit(NEW, quota=day)
    catalogue.finish(f"{other}-0", 1, BlockEnd(BlockState.done))
    clock.now += 24 * HOUR - 300.0  # in the 24th hour, with that of the attempts
    assert catalogue.use_of("ada").computed == pytest.approx(102.0)
    clock.now += HOUR
    assert catalogue.use_of("ada") == Use(live=1, running=0, stored=0, computed=0.0)
    assert catalogue.use_of("bob") == Use(0, 0, 0, 0.0)


def test_hours_that_count_no_longer_are_forgotten(catalogue: Catalogue, clock: Clock) -> None:
    job = catalogue.submit(NEW).job.id
    assert catalogue.claim_block(f"{job}-0", "one", HOUR)
    catalogue.finish(f"{job}-0", 1, BlockEnd(BlockState.done))

    def rows() -> int:
        with catalogue.connections.reading() as connection:
            return len(connection.execute(select(tables.usage)).all())

    catalogue.reap(9)
    assert rows() == 1
    clock.now += 25 * HOUR
    catalogue.reap(9)
    assert rows() == 0
