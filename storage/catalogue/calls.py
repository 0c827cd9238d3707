"""Calls of the functions that PostgreSQL carries out by itself; see `functions`."""

import json
from collections.abc import Collection
from dataclasses import asdict
from typing import Any, Final

from sqlalchemy import Float, Table, text

from jointplay.records.job import JobError
from jointplay.storage.catalogue import tables
from jointplay.storage.catalogue.connections import Unit
from jointplay.storage.catalogue.errors import Fenced
from jointplay.storage.catalogue.records import (
    QUEUES,
    Block,
    BlockEnd,
    BlockState,
    Claim,
    Job,
    JobState,
    Solver,
    Verdict,
)

_OF_FLOATS: Final = {
    table: [(column.name, isinstance(column.type, Float)) for column in table.c]
    for table in (tables.block, tables.job)
}


def _claiming(call: str) -> str:
    # two documents: to take forty columns over costs the client as much as all the rest
    return f"SELECT row_to_json(held), row_to_json(of_job) FROM {call}"  # noqa: S608 - our own names


_CLAIM = _claiming(
    "claim_block(%(wanted)s, %(claimant)s, %(moment)s, %(lease)s, %(version)s, %(processor)s)"
)
_CLAIM_NEXT = _claiming(
    "claim_next(%(claimant)s, %(moment)s, %(lease)s, %(version)s, %(processor)s, %(queues)s,"
    " %(busy)s)"
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
    return _claimed(unit.connection.exec_driver_sql(_CLAIM, asked).one_or_none())


def claim_next(
    unit: Unit, worker: str, lease: float, solver: Solver, busy: Collection[str]
) -> Claim | None:
    """See `claims.claim_next`; blocks that others are about to take are left to them."""
    asked = {"claimant": worker, "moment": unit.now, "lease": lease}
    asked |= {"version": solver.version, "processor": solver.processor}
    asked |= {"queues": list(QUEUES), "busy": list(busy)}
    return _claimed(unit.connection.exec_driver_sql(_CLAIM_NEXT, asked).one_or_none())


def _claimed(row: Any) -> Claim | None:
    if row is None:
        return None
    held, of_job = _read(tables.block, row[0]), _read(tables.job, row[1])
    held["state"] = BlockState(held["state"])
    of_job["state"] = JobState(of_job["state"])
    of_job["error"] = of_job["error"] and JobError(**of_job["error"])
    return Claim(Block(**held), Job(**of_job))


def _read(table: Table, document: dict[str, Any]) -> dict[str, Any]:
    """Return a row from its document, in which 2.0 may be 2, and which may have later columns."""
    return {
        name: float(document[name]) if is_float and document[name] is not None else document[name]
        for name, is_float in _OF_FLOATS[table]
    }


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


def finish(unit: Unit, block_id: str, attempt: int, end: BlockEnd) -> JobState:
    """See `ending.finish`."""
    asked = {
        "wanted": block_id,
        "number": attempt,
        "moment": unit.now,
        "ending": end.outcome,
        "failure": None if end.error is None else json.dumps(asdict(end.error)),
        "reached": end.time,
        "fraction": end.fraction,
        "done": end.steps,
    }
    state = unit.execute(_FINISH, asked).scalar_one()
    if state is None:
        raise Fenced(block_id, attempt)
    if state not in set(JobState):
        raise ValueError(f"the job of block {block_id} {state}")
    return JobState(state)
