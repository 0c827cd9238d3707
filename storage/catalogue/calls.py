"""Calls of the functions that PostgreSQL carries out by itself; see `functions`."""

import json
from collections.abc import Collection
from dataclasses import asdict
from typing import Any

from sqlalchemy import TextualSelect, text

from jointplay.records.job import JobError
from jointplay.storage.catalogue import tables
from jointplay.storage.catalogue.connections import Unit
from jointplay.storage.catalogue.errors import Fenced
from jointplay.storage.catalogue.records import (
    QUEUES,
    Block,
    BlockState,
    Claim,
    Job,
    JobState,
    Solver,
    Verdict,
)


def _columns(record: str, names: list[str]) -> str:
    return ", ".join(f'({record})."{name}"' for name in names)


_BLOCK, _JOB = ([column.name for column in table.c] for table in (tables.block, tables.job))


def _claiming(call: str) -> TextualSelect:
    columns = f"{_columns('held', _BLOCK)}, {_columns('of_job', _JOB)}"
    # our own names
    return text(f"SELECT {columns} FROM {call}").columns(*tables.block.c, *tables.job.c)  # noqa: S608


_CLAIM = _claiming("claim_block(:wanted, :claimant, :moment, :lease, :version, :processor)")
_CLAIM_NEXT = _claiming(
    "claim_next(:claimant, :moment, :lease, :version, :processor, :queues, :busy)"
)
_PROGRESS = text(
    "SELECT record_progress(:wanted, :number, :until, :reached, :fraction, CAST(:done AS bigint))"
)
_FINISH = text(
    "SELECT finish_block(:wanted, :number, :moment, :ending, CAST(:failure AS json), :reached,"
    " :fraction, CAST(:done AS bigint))"
)


def claim(
    unit: Unit, block_id: str, worker: str, lease: float, solver: Solver | None
) -> Claim | None:
    """See `claims.claim`."""
    asked = {"wanted": block_id, "claimant": worker, "moment": unit.now, "lease": lease}
    asked |= {"version": solver and solver.version, "processor": solver and solver.processor}
    return _claimed(unit.execute(_CLAIM, asked).one_or_none())


def claim_next(
    unit: Unit, worker: str, lease: float, solver: Solver, busy: Collection[str]
) -> Claim | None:
    """See `claims.claim_next`; blocks that others are about to take are left to them."""
    asked = {"claimant": worker, "moment": unit.now, "lease": lease}
    asked |= {"version": solver.version, "processor": solver.processor}
    asked |= {"queues": list(QUEUES), "busy": list(busy)}
    return _claimed(unit.execute(_CLAIM_NEXT, asked).one_or_none())


def _claimed(row: Any) -> Claim | None:
    if row is None:
        return None
    held = dict(zip(_BLOCK, row, strict=False))
    of_job = dict(zip(_JOB, row[len(_BLOCK) :], strict=True))
    return Claim(Block(**held), Job(**of_job))


def record_progress(
    unit: Unit,
    block_id: str,
    attempt: int,
    lease: float,
    *,
    time: float,
    fraction: float,
    steps: int | None = None,
) -> Verdict:
    """See `holding.record_progress`."""
    asked = {
        "wanted": block_id,
        "number": attempt,
        "until": unit.now + lease,
        "reached": time,
        "fraction": fraction,
        "done": steps,
    }
    state = unit.execute(_PROGRESS, asked).scalar_one()
    if state is None:
        raise Fenced(block_id, attempt)
    return Verdict.go_on if state == JobState.running else Verdict.cancel


def finish(
    unit: Unit,
    block_id: str,
    attempt: int,
    outcome: BlockState,
    error: JobError | None,
    *,
    time: float | None,
    fraction: float | None,
    steps: int | None,
) -> JobState:
    """See `ending.finish`."""
    asked = {
        "wanted": block_id,
        "number": attempt,
        "moment": unit.now,
        "ending": outcome,
        "failure": None if error is None else json.dumps(asdict(error)),
        "reached": time,
        "fraction": fraction,
        "done": steps,
    }
    state = unit.execute(_FINISH, asked).scalar_one()
    if state is None:
        raise Fenced(block_id, attempt)
    if state not in set(JobState):
        raise ValueError(f"the job of block {block_id} {state}")
    return JobState(state)
