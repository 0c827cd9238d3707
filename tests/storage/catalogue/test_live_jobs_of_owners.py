"""Quotas of owners, also where many ask for jobs at the same time."""

from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from dataclasses import replace
from itertools import islice

import pytest

from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import QuotaExceeded
from jointplay.storage.catalogue.records import NewJob, SubmissionKey

NEW = NewJob("simulate", {"duration": 2.0}, "d" * 64, "0.1.0+abc", owner="ada")
MOST = 5


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
                    through.submit(new, most_live=MOST)
                    return 1
                through.submit_batch([new, new], owner=new.owner, most_live=MOST)
                return 2
            except QuotaExceeded:
                return 0

        with ThreadPoolExecutor(10) as threads:
            found = list(threads.map(accepted, enumerate(islice(jobs_of("ada"), 20))))
        assert sum(found) == len(one.jobs(owner="ada").jobs)
        assert sum(found) == MOST


def test_what_makes_no_job_is_answered_at_the_limit(catalogue: Catalogue) -> None:
    key = SubmissionKey("again", "f", owner="ada")
    made = [catalogue.submit(new, most_live=2) for new in islice(jobs_of("ada"), 1)]
    made.append(catalogue.submit(NEW, key, most_live=2))
    assert catalogue.submit(NEW, key, most_live=2).job.id == made[1].job.id
    assert catalogue.submit(NEW, reuse=True, most_live=2).cached
    with pytest.raises(QuotaExceeded, match=r"ada has 2 jobs .* may have 2; this would be 1 more"):
        catalogue.submit(NEW, most_live=2)
    with pytest.raises(QuotaExceeded, match="this would be 3 more"):
        catalogue.submit_batch([NEW] * 3, owner="ada", most_live=2)
    catalogue.submit(replace(NEW, owner="bob"), most_live=1)
    catalogue.submit(NEW)  # any number
    for answer in made:
        catalogue.request_cancel(answer.job.id)
    assert catalogue.submit(NEW, most_live=2).created
