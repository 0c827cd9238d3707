"""Counters that never fall: ends of attempts by outcome, and what workers have spent seconds on.

Each worker has rows of its own, so that no two units wait for each other; those of workers that are
known no more are added up.
"""

from collections.abc import Mapping
from typing import Final

from sqlalchemy import delete, func, select, text

from jointplay.storage.catalogue import tables
from jointplay.storage.catalogue.connections import Unit

_tally = tables.tally
_ADD: Final = text(
    "INSERT INTO tally (name, worker, value) VALUES (:name, :worker, :amount)"
    " ON CONFLICT (name, worker) DO UPDATE SET value = tally.value + excluded.value"
)


def add(unit: Unit, name: str, worker: str, amount: float = 1.0) -> None:
    """Count what one worker did."""
    unit.execute(_ADD, {"name": name, "worker": worker, "amount": amount})


def note_spent(unit: Unit, worker: str, amounts: Mapping[str, float]) -> None:
    """Count several things that one worker did."""
    for name, amount in sorted(amounts.items()):
        add(unit, name, worker, amount)


def totals(unit: Unit) -> dict[str, float]:
    """Return all counters; those that nothing was counted of are not there."""
    sums = select(_tally.c.name, func.sum(_tally.c.value)).group_by(_tally.c.name)
    return {name: float(value) for name, value in unit.execute(sums)}


def gather(unit: Unit) -> None:
    """Add up the rows of workers that are known no more."""
    known = select(tables.worker.c.name)
    gone = (_tally.c.worker != "") & _tally.c.worker.not_in(known)
    rows = unit.execute(delete(_tally).where(gone).returning(_tally.c.name, _tally.c.value)).all()
    for name, value in sorted(rows):
        add(unit, name, "", value)
