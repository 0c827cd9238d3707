"""Inconsistent rows of the catalogue, which no unit of writing leaves behind.

They come from a database that was edited, restored from parts, or opened without its rules; and
from leases that nobody looks after because no relay runs.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Final

from sqlalchemy import ColumnElement, Select, Table, and_, delete, exists, func, select

from jointplay.storage.catalogue import tables, upkeep
from jointplay.storage.catalogue.connections import Unit
from jointplay.storage.catalogue.ending import queue_again, settle
from jointplay.storage.catalogue.records import TERMINAL, BlockState
from jointplay.storage.catalogue.submission import drop_blocks

_AT_ONCE = 10_000  # rows; the next look finds the rest
_job, _block, _outbox = tables.job, tables.block, tables.outbox
_ended = _job.c.state.in_(TERMINAL)
_live = _block.c.state.in_((BlockState.queued, BlockState.running))


@dataclass(frozen=True)
class Patience:
    """Times that things may take before something is wrong, s, and losses that a block may have."""

    lease: float
    republish_after: float
    max_attempts: int


@dataclass(frozen=True)
class Inconsistency:
    """One kind of inconsistency: how it is found, and what mends it."""

    subject: str
    found: str
    mended: str
    find: Callable[[Unit, Patience], Sequence[str]]
    """Ids of what is inconsistent."""
    mend: Callable[[Unit, Patience, Sequence[str]], None] | None
    """Called with what was found in the same unit; none: a user has to decide."""
    settles: bool = False
    """It may be about to mend itself: the living need the time for a heartbeat first."""


def find(unit: Unit, kind: Inconsistency, patience: Patience) -> tuple[str, ...]:
    """Return the ids of all rows that are inconsistent in one way."""
    return tuple(kind.find(unit, patience))


def mend(unit: Unit, kind: Inconsistency, patience: Patience) -> None:
    """Mend what is inconsistent in one way now."""
    if kind.mend is not None:
        kind.mend(unit, patience, kind.find(unit, patience))


def _ids(unit: Unit, statement: Select[tuple[str]]) -> list[str]:
    return list(unit.execute(statement.limit(_AT_ONCE)).scalars())


def _lost_rows() -> Iterator[tuple[Table, ColumnElement[bool]]]:
    """Yield each table with the rows in it whose job or block is not there."""
    for table in tables.metadata.sorted_tables:
        for key in table.foreign_keys:
            missing = ~exists().where(key.column == key.parent)
            yield table, and_(key.parent.is_not(None), missing)


def _orphans(unit: Unit, _: Patience) -> list[str]:
    found = []
    for table, lost in _lost_rows():
        number = unit.execute(select(func.count()).select_from(table).where(lost)).scalar_one()
        if number:
            found.append(f"{number} in {table.name}")
    return found


def _remove_orphans(unit: Unit, _: Patience, _found: Sequence[str]) -> None:
    for table, lost in _lost_rows():
        unit.execute(delete(table).where(lost))


def _needless(unit: Unit, _: Patience) -> list[str]:
    of_block = select(_outbox.c.block).join(_block, _block.c.id == _outbox.c.block)
    return _ids(unit, of_block.where(_block.c.state != BlockState.queued))


def _forget(unit: Unit, _: Patience, found: Sequence[str]) -> None:
    unit.execute(delete(_outbox).where(_outbox.c.block.in_(found)))


def _silent(unit: Unit, _: Patience) -> list[str]:
    announced = exists().where(_outbox.c.block == _block.c.id)
    of_job = select(_block.c.id).join(_job, _job.c.id == _block.c.job)
    return _ids(unit, of_job.where(_block.c.state == BlockState.queued, ~_ended, ~announced))


def _announce(unit: Unit, _: Patience, found: Sequence[str]) -> None:
    for block in found:
        queue_again(unit, block)


def _left_behind(unit: Unit, _: Patience) -> list[str]:
    waits = _block.c.state.in_((BlockState.queued, BlockState.waiting))
    of_job = select(_block.c.id).join(_job, _job.c.id == _block.c.job)
    return _ids(unit, of_job.where(waits, _ended))


def _drop(unit: Unit, _: Patience, found: Sequence[str]) -> None:
    drop_blocks(unit, _block.c.id.in_(found), untouched=False)


def _late(unit: Unit, patience: Patience) -> ColumnElement[bool]:
    return _block.c.lease_until < unit.now - patience.lease


def _overdue(unit: Unit, patience: Patience) -> list[str]:
    late = _late(unit, patience)
    return _ids(unit, select(_block.c.id).where(_block.c.state == BlockState.running, late))


def _take_back(unit: Unit, patience: Patience, found: Sequence[str]) -> None:
    columns = select(_block.c.id, _block.c.attempt, _block.c.job)
    rows = unit.execute(columns.where(_block.c.id.in_(found))).all()
    for _ in upkeep.take_back(unit, rows, _late(unit, patience), patience.max_attempts):
        pass


def _ahead(unit: Unit, patience: Patience) -> list[str]:
    held, late = upkeep.too_far_ahead(unit, patience.lease, patience.republish_after)
    leases = _ids(unit, select(_block.c.id).where(held))
    return leases + _ids(unit, select(_outbox.c.block).where(late))


def _shorten(unit: Unit, patience: Patience, _: Sequence[str]) -> None:
    upkeep.mend_after_setting_back(unit, patience.lease, patience.republish_after)


def _idle(*states: BlockState) -> Select[tuple[str]]:
    """Select jobs that have not ended, whose blocks are all in one of some states."""
    of_job = _block.c.job == _job.c.id
    other = exists().where(of_job, _block.c.state.not_in(states))
    return select(_job.c.id).where(~_ended, exists().where(of_job), ~other)


def _unsettled(unit: Unit, _: Patience) -> list[str]:
    return _ids(unit, _idle(BlockState.done, BlockState.waiting))


def _settle(unit: Unit, _: Patience, found: Sequence[str]) -> None:
    for job in found:
        settle(unit, job, None)


def _hopeless(unit: Unit, patience: Patience) -> list[str]:
    going = exists().where(_block.c.job == _job.c.id, _live)
    idle = _ids(unit, select(_job.c.id).where(~_ended, ~going))
    settled = set(_unsettled(unit, patience))
    return [job for job in idle if job not in settled]


INCONSISTENCIES: Final = (
    Inconsistency("rows", "their job or block is not there", "removed", _orphans, _remove_orphans),
    Inconsistency(
        "block", "waits for a worker, and no wake-up is due", "announced", _silent, _announce
    ),
    Inconsistency("wake-up", "of a block that waits for no worker", "removed", _needless, _forget),
    Inconsistency("block", "waits, though its job has ended", "cancelled", _left_behind, _drop),
    Inconsistency(
        "block",
        "its lease ran out long ago, and no relay took it back",
        "taken back",
        _overdue,
        _take_back,
        settles=True,
    ),
    Inconsistency(
        "block",
        "held, or not announced, for longer than can be: the clock was set back",
        "shortened",
        _ahead,
        _shorten,
    ),
    Inconsistency("job", "has not ended, though its blocks have", "settled", _unsettled, _settle),
    Inconsistency("job", "has not ended, and nothing of it will be computed", "", _hopeless, None),
)
"""In the order in which they are mended: what one leaves may be another's."""
