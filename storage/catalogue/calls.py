"""Calls of the functions that PostgreSQL carries out by itself; see `functions`."""

from collections.abc import Collection
from typing import Any, Final

from sqlalchemy import Float, Table

from jointplay.records.job import JobError
from jointplay.storage.catalogue import tables
from jointplay.storage.catalogue.connections import Unit
from jointplay.storage.catalogue.records import (
    QUEUES,
    Block,
    BlockState,
    Claim,
    Job,
    JobState,
    Solver,
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
