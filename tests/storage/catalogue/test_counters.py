"""Counters that never fall, whoever counts, and whatever becomes of him."""

from collections.abc import Callable, Iterator

import pytest
from sqlalchemy import func, select
from stepped_clock import Clock

from jointplay.records.job import JobError
from jointplay.storage.catalogue import solvers, tables
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import BlockEnd, BlockState, NewJob, Solver

NEW = NewJob("simulate", {}, "d" * 64, "1")
ERROR = JobError("solver", "step-limit", "it took too many steps")
OWN = Solver("1", "here")


@pytest.fixture
def catalogue(new_url: Callable[[], str], clock: Clock) -> Iterator[Catalogue]:
    catalogue = Catalogue(new_url(), clock=clock)
    yield catalogue
    catalogue.close()


def claimed(catalogue: Catalogue, worker: str) -> str:
    block = f"{catalogue.submit(NEW).job.id}-0"
    assert catalogue.claim_block(block, worker, 30.0)
    return block


def test_every_end_of_an_attempt_is_counted_for_good(catalogue: Catalogue, clock: Clock) -> None:
    for worker in ("one", "two"):
        catalogue.note_worker(worker, OWN)
        catalogue.finish(claimed(catalogue, worker), 1, BlockEnd(BlockState.done))
        catalogue.finish(claimed(catalogue, worker), 1, BlockEnd(BlockState.failed, ERROR))
        catalogue.release(claimed(catalogue, worker), 1)
        catalogue.put_off(claimed(catalogue, worker), 1, "waiting")
        claimed(catalogue, worker)
        catalogue.note_spent(worker, {"seconds of compiling": 1.5})
    clock.now += 31.0
    catalogue.reap(3)
    ends = ("done", "failed", "released", "put-off", "lost")
    expected = {f"attempts {end}": 2.0 for end in ends} | {"seconds of compiling": 3.0}
    assert catalogue.census().totals == expected
    catalogue.forget_workers(["one", "two"])
    assert catalogue.census().totals == expected
    with catalogue.connections.reading() as connection:
        rows = connection.execute(select(func.count()).select_from(tables.tally)).scalar_one()
    assert rows == len(expected)
    catalogue.finish(claimed(catalogue, "one"), 1, BlockEnd(BlockState.done))
    assert catalogue.census().totals == expected | {"attempts done": 3.0}


def test_jobs_whose_solver_no_worker_has_are_counted(catalogue: Catalogue, clock: Clock) -> None:
    catalogue.submit(NEW)
    assert catalogue.census().unserved == 0
    clock.now += solvers.PATIENCE + 1.0
    catalogue.note_worker("other", Solver("2", "here"))
    catalogue.note_unserved()
    assert catalogue.census().unserved == 1
    catalogue.note_worker("own", OWN)
    assert catalogue.census().unserved == 0
