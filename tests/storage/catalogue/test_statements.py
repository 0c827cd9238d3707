"""Statements that a worker's question about a block takes."""

from collections.abc import Callable
from typing import Any

import pytest
from sqlalchemy import Engine, event

from jointplay.records.job import JobError
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.catalogue.records import BlockEnd, BlockState, JobState, NewJob, Solver

SOLVER = Solver("1", "skylake")


def asked(unit: Callable[[], object]) -> int:
    """Count the statements of a unit, without those that set up a session."""
    found: list[str] = []

    def note(_connection: Any, _cursor: Any, statement: str, *_: Any) -> None:
        found.append(statement)

    event.listen(Engine, "before_cursor_execute", note)
    unit()
    event.remove(Engine, "before_cursor_execute", note)
    return len([one for one in found if not one.startswith("SET ")])


def study(catalogue: Catalogue, blocks: int) -> str:
    cuts = tuple((number, 1) for number in range(blocks))
    new = NewJob("sweep", {}, "d" * 64, "1", blocks=cuts, seal=True, owner="ada")
    return catalogue.submit(new).job.id


@pytest.mark.parametrize("blocks", [1, 40])
def test_what_a_worker_asks_takes_few_statements(catalogue: Catalogue, blocks: int) -> None:
    """However many blocks there are; PostgreSQL claims in one: claimants wait for each other."""
    block = f"{study(catalogue, blocks)}-0"
    with catalogue.connections.reading() as connection:
        most = 1 if connection.dialect.name == "postgresql" else 15
    counts = [
        asked(lambda: catalogue.claim_next("worker", 30.0, SOLVER)),
        asked(lambda: catalogue.record_progress(block, 1, 30.0, time=1.0, fraction=0.5)),
        asked(lambda: catalogue.finish(block, 1, BlockEnd(BlockState.done, time=2.0, steps=9))),
    ]
    assert counts[0] <= most
    assert counts[1] == 3
    assert counts[2] <= 9


def test_a_failed_block_ends_the_others(catalogue: Catalogue) -> None:
    job = study(catalogue, 3)
    for index in range(2):
        assert catalogue.claim_block(f"{job}-{index}", "worker", 30.0)
    error = JobError("solver", "diverged", 'it\'s "wide"', time=1.5)
    assert catalogue.finish(f"{job}-0", 1, BlockEnd(BlockState.failed, error)) is JobState.failed
    late = JobError("solver", "late", "second")
    assert catalogue.finish(f"{job}-1", 1, BlockEnd(BlockState.failed, late)) is JobState.failed
    found = catalogue.get(job)
    assert (found.error, found.finished is not None) == (error, True)
    assert [block.state.value for block in catalogue.blocks(job)] == [
        "failed",
        "failed",
        "cancelled",
        "cancelled",
    ]
    *_, last = catalogue.events(job)
    assert (last.type, last.data["error"]["code"]) == ("failed", "diverged")
    assert catalogue.due_wake_ups(10) == ()


def test_the_last_block_has_the_store_sealed(catalogue: Catalogue) -> None:
    job = study(catalogue, 2)
    states = []
    for index in (0, 1, 2):
        claim = catalogue.claim_next("worker", 30.0, SOLVER)
        assert claim is not None
        assert claim.block.id == f"{job}-{index}"
        states.append(catalogue.finish(claim.block.id, 1, BlockEnd(BlockState.done)))
    assert states == [JobState.running, JobState.running, JobState.succeeded]
    assert catalogue.get(job).progress_fraction == 1.0
    assert catalogue.use_of("ada").live == 0


def test_a_block_of_a_job_that_nobody_cancelled_is_not(catalogue: Catalogue) -> None:
    job = study(catalogue, 1)
    assert catalogue.claim_block(f"{job}-0", "worker", 30.0)
    with pytest.raises(ValueError, match="was not asked to be cancelled"):
        catalogue.finish(f"{job}-0", 1, BlockEnd(BlockState.cancelled))
    assert catalogue.blocks(job)[0].state is BlockState.running
    catalogue.request_cancel(job)
    assert catalogue.finish(f"{job}-0", 1, BlockEnd(BlockState.cancelled)) is JobState.cancelled
