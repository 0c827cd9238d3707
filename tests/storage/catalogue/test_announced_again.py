"""Workers that were woken for a block and take another one, or none: it is not left waiting."""

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from dataclasses import replace

import psycopg
from sqlalchemy import update
from stepped_clock import Clock

from jointplay.storage.catalogue import tables
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import BlockState, JobState, NewJob, Solver
from tests.waiting import until

RUNNING, FAILED = {"state": BlockState.running}, {"state": JobState.failed}
SOLVER = Solver("1", "skylake")
RUN = NewJob("simulate", {}, "d" * 64, "1")


def submitted(catalogue: Catalogue, count: int) -> list[str]:
    """Submit jobs and return their only blocks."""
    runs = (replace(RUN, digest=f"{number:064}") for number in range(count))
    return [f"{catalogue.submit(one).job.id}-0" for one in runs]


def woken(catalogue: Catalogue, block: str) -> str | None:
    """Claim as a worker that was woken for a block does; return the block that it has."""
    found = catalogue.claim_next("worker", 30.0, SOLVER)
    if found is None or found.block.id != block:
        catalogue.wake_again(block, SOLVER)
    return found and found.block.id


def due(catalogue: Catalogue) -> list[str]:
    return [one.block for one in catalogue.due_wake_ups(10)]


def test_a_message_that_was_sent_is_noted_after_its_worker_took_another_block(
    catalogue: Catalogue, clock: Clock
) -> None:
    """The worker may be quicker than the relay, which notes what it has sent to Redis."""
    first, second = submitted(catalogue, 2)
    seen = catalogue.clock()
    assert due(catalogue) == [first, second]
    clock.now += 0.001
    assert woken(catalogue, second) == first
    catalogue.mark_published((first, second), 1000.0, seen=seen)
    assert due(catalogue) == [second]


def test_a_message_that_comes_twice_cuts_no_pause_short(catalogue: Catalogue, clock: Clock) -> None:
    (block,) = submitted(catalogue, 1)
    catalogue.mark_published((block,), 1000.0)
    assert woken(catalogue, block) == block
    catalogue.put_off(block, 1, "waiting for room on the disk")
    assert woken(catalogue, block) is None
    assert due(catalogue) == []
    clock.now += 10.0
    assert due(catalogue) == [block]


def test_workers_that_take_each_others_block_do_not_wait_for_each_other(
    new_database: Callable[[], str],
) -> None:
    """Each takes one away, and asks for the other; PostgreSQL ends such a knot after a second."""
    url = new_database()
    with closing(Catalogue(url)) as catalogue, psycopg.connect(url) as other:
        first, second = submitted(catalogue, 2)
        other.execute("DELETE FROM outbox WHERE block = %s", (second,))
        with ThreadPoolExecutor(1) as threads:
            claiming = threads.submit(woken, catalogue, second)
            until(lambda: catalogue.blocks(first[:26])[0].state is BlockState.running)
            other.execute("UPDATE outbox SET tries = 0 WHERE block = %s", (first,))
            other.commit()
            assert claiming.result() == first
        assert due(catalogue) == []


def test_a_wake_up_of_nothing_keeps_nobody_waiting(catalogue: Catalogue) -> None:
    """As a catalogue has them that was restored from parts, until `doctor` removes them."""
    nothing, ended, block = submitted(catalogue, 3)
    with catalogue.connections.writing() as connection:
        connection.execute(update(tables.block).where(tables.block.c.id == nothing), RUNNING)
        connection.execute(update(tables.job).where(tables.job.c.id == ended[:26]), FAILED)
    assert woken(catalogue, nothing) == block
    assert due(catalogue) == [ended]


def test_a_block_whose_wake_up_brought_another_one_is_announced_again(
    catalogue: Catalogue,
) -> None:
    (first,) = submitted(catalogue, 1)
    (study,) = catalogue.submit_batch([RUN]).jobs
    catalogue.mark_published((f"{study}-0",), 1000.0)
    assert woken(catalogue, f"{study}-0") == first
    assert due(catalogue) == [f"{study}-0"]
