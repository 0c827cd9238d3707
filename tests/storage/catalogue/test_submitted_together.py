"""Submissions at the same time share a transaction, and nothing else: in SQLite.

There a writer holds up all others, by which these tests have submissions gather; of PostgreSQL see
`test_shared_database.py`.
"""

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from typing import Any

import pytest
from sqlalchemy import Engine, event

from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.errors import KeyReused
from jointplay.storage.catalogue.records import NewJob, SubmissionKey, Submitted

NEW = NewJob("simulate", {"duration": 2.0}, "d" * 64, "0.1.0+abc")
MANY = 20


def at_the_same_time(
    catalogue: Catalogue, url: str, submissions: Sequence[Callable[[], Submitted]]
) -> tuple[list[Any], int]:
    """Return answers or errors, and the writing transactions that they took.

    Another process's transaction lasts until all of them wait.
    """
    committed: list[Any] = []

    def count(connection: Any) -> None:
        committed.append(connection)

    def outcome(submission: Callable[[], Submitted]) -> Any:
        try:
            return submission()
        except Exception as error:  # noqa: BLE001 - is what is looked at
            return error

    other = Catalogue(url)
    with ThreadPoolExecutor(len(submissions)) as threads:
        with other.connections.writing():
            event.listen(Engine, "commit", count)
            waiting = [threads.submit(outcome, submission) for submission in submissions]
            while len(catalogue._submissions._waiting) < len(submissions) - 1:
                pass  # the first has taken its own
        found = [one.result() for one in waiting]
    event.remove(Engine, "commit", count)
    other.close()
    return found, len(committed) - 1  # without the other process's


def test_many_jobs_are_stored_in_few_transactions(new_file: Callable[[], str]) -> None:
    url = new_file()
    catalogue = Catalogue(url)
    news = [replace(NEW, digest=f"{index:064}") for index in range(MANY)]
    found, transactions = at_the_same_time(
        catalogue, url, [lambda new=new: catalogue.submit(new, reuse=True) for new in news]
    )
    assert transactions == 2  # the first one's, and one for all others
    assert len({answer.job.id for answer in found}) == MANY
    for new, answer in zip(news, found, strict=True):
        assert answer.created
        assert catalogue.get(answer.job.id) == answer.job
        assert answer.job.digest == new.digest
        assert [block.job for block in catalogue.blocks(answer.job.id)] == [answer.job.id]
    assert len(catalogue.due_wake_ups(1000)) == MANY
    catalogue.close()


def test_of_equal_jobs_one_is_made(new_file: Callable[[], str]) -> None:
    url = new_file()
    catalogue = Catalogue(url)
    found, _ = at_the_same_time(catalogue, url, [lambda: catalogue.submit(NEW, reuse=True)] * MANY)
    assert len({answer.job.id for answer in found}) == 1
    assert sorted(answer.created for answer in found) == [False] * (MANY - 1) + [True]
    catalogue.close()


def test_whoever_is_refused_spoils_nothing(new_file: Callable[[], str]) -> None:
    url = new_file()
    catalogue = Catalogue(url)
    catalogue.submit(NEW, SubmissionKey("known", "a"))
    unstorable = replace(NEW, label="\ud800")  # not a text that has UTF-8
    bad = [
        lambda: catalogue.submit(NEW, SubmissionKey("known", "b")),
        lambda: catalogue.submit(unstorable),
    ]
    good = [
        lambda k=k: catalogue.submit(NEW, SubmissionKey(f"key {k % 9}", "c")) for k in range(18)
    ]
    found, _ = at_the_same_time(catalogue, url, [*bad, *good])
    assert isinstance(found[0], KeyReused)
    assert isinstance(found[1], UnicodeEncodeError)
    assert len({answer.job.id for answer in found[2:]}) == 9  # each key came twice
    assert len(catalogue.jobs(limit=1000).jobs) == 10
    with pytest.raises(KeyReused):
        catalogue.submit(NEW, SubmissionKey("known", "b"))
    catalogue.close()
