"""Marks of the places whose files belong to the catalogue."""

from sqlalchemy import insert, select

from jointplay.storage.catalogue import tables
from jointplay.storage.catalogue.connections import Unit


def mark_of(unit: Unit, place: str) -> str | None:
    """Return the mark that a place must have; none if none was noted."""
    table = tables.installation
    found = unit.execute(select(table.c.mark).where(table.c.place == place)).scalar_one_or_none()
    return None if found is None else str(found)


def note_mark(unit: Unit, place: str, mark: str) -> str:
    """Note the mark of a place, unless there is one already. Returns the one that holds."""
    known = mark_of(unit, place)
    if known is None:
        unit.execute(insert(tables.installation).values(place=place, mark=mark))
    return known or mark
