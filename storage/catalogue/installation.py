"""Marks of the data folder and the object store whose files belong to the catalogue."""

from sqlalchemy import insert, select

from jointplay.storage.catalogue import tables
from jointplay.storage.catalogue.connections import Unit


def mark_of(unit: Unit, part: str) -> str | None:
    """Return the mark that the files of a part of the installation must have; none: not noted.

    `part` : ``data`` or ``results``.
    """
    table = tables.installation
    found = unit.execute(select(table.c.mark).where(table.c.place == part)).scalar_one_or_none()
    return None if found is None else str(found)


def note_mark(unit: Unit, part: str, mark: str) -> str:
    """Note the mark of a part, unless there is one already. Returns the one that holds."""
    known = mark_of(unit, part)
    if known is None:
        unit.execute(insert(tables.installation).values(place=part, mark=mark))
    return known or mark
