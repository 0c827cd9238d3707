"""Units cost no more than they must, however many blocks wait."""

import sqlite3
from collections.abc import Callable, Iterator

import pytest
from sqlalchemy import Engine, event
from stepped_clock import Clock

from jointplay.storage.catalogue import solvers
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import NewJob, Solver

NEW = NewJob("simulate", {}, "digest", "0")


class Work:
    """Counts what SQLite does, in hundreds of its instructions."""

    def __init__(self) -> None:
        self.hundreds = 0

    def connect(self, connection: sqlite3.Connection, _: object) -> None:
        connection.set_progress_handler(self.count, 100)

    def count(self) -> int:
        self.hundreds += 1
        return 0


@pytest.fixture
def work() -> Iterator[Work]:
    counted = Work()
    event.listen(Engine, "connect", counted.connect)
    yield counted
    event.remove(Engine, "connect", counted.connect)


def test_the_rows_of_other_jobs_are_not_looked_at(work: Work, new_file: Callable[[], str]) -> None:
    catalogue = Catalogue(new_file())
    found = []
    for others in (100, 2000):
        catalogue.submit_batch([NEW] * others, label=None, key=None)
        jobs = [catalogue.submit(NEW).job.id for _ in range(10)]
        before = work.hundreds
        for job in jobs:
            catalogue.request_cancel(job)
        found.append(work.hundreds - before)
    catalogue.close()
    assert found[0] > 0
    assert found[1] < 2 * found[0]


def test_a_worker_passes_a_block_of_others_by_without_a_look_at_the_rest_of_its_study(
    work: Work, new_file: Callable[[], str], clock: Clock
) -> None:
    found = []
    for blocks in (100, 1000):
        catalogue = Catalogue(new_file(), clock=clock)
        study = NewJob("sweep", {}, "digest", "0", blocks=tuple((n, 1) for n in range(blocks)))
        catalogue.submit(study)
        assert catalogue.claim_next("begins it", 1e6, Solver("0", "skylake"))
        clock.now += 2 * solvers.PATIENCE
        before = work.hundreds
        assert catalogue.claim_next("looks for work", 30.0, Solver("0", "zen4")) is None
        found.append(work.hundreds - before)
        catalogue.close()
    assert found[1] < 2 * 10 * found[0]
