"""Questions to tables of jobs, in Python and on the command line: which ones make sense."""

import math
from collections.abc import Mapping
from typing import Literal

from jointplay.records.window_query import WindowQuery, wrong_end

Table = Literal["history", "poincare", "peaks", "impacts", "points"]
TABLES: Mapping[bool, tuple[Table, ...]] = {
    False: ("history", "poincare", "peaks", "impacts"),
    True: ("poincare", "points"),
}
"""Tables of a simulation (False) and of a study (True); the first is meant where none is named."""


class NoSuchTable(ValueError):
    """The job has no such table; the sentence lists those that it has."""


class NoSuchPart(ValueError):
    """A table has no such part; the sentence begins with what asks for it, such as ``start``."""


def check(table: Table | None, query: WindowQuery, *, of_study: bool) -> None:
    """Refuse what a table does not have, and what would have no effect on it.

    Parameters
    ----------
    table
        None: the usual one of the job.
    query
        Part of it.
    of_study
        Whether the job is a study.

    Raises
    ------
    NoSuchTable
        A job of this kind has no such table.
    NoSuchPart
        This table has no spans, instants or channels, or the window ends before it begins.
    """
    known = TABLES[of_study]
    if table is not None and table not in known:
        what = "a study" if of_study else "a simulation"
        raise NoSuchTable(f"{what} has no table {table!r}; it has {', '.join(known)}.")
    shown = "a table of a study" if of_study else table or "history"
    for option, asked in (("points", query.points), ("step", query.step)):
        if asked is not None and shown != "history":
            raise NoSuchPart(f"{option} is of a history; {shown} is written as it is.")
    if query.channels is not None and shown == "impacts":
        raise NoSuchPart("channels are not in the table impacts; leave them out.")
    if (wrong := wrong_end(query.start, query.stop, "" if of_study else " s")) is not None:
        raise NoSuchPart(wrong[1])


def point_range(points: int, start: float | None, stop: float | None) -> range:
    """Return the points of a study from `start` on and before `stop`.

    Raises
    ------
    NoSuchPart
        One of them is no whole number from 0 on, or there is no point between them.
    """
    for option, value in (("start", start), ("stop", stop)):
        if value is not None and not (math.isfinite(value) and value >= 0 and value == int(value)):
            raise NoSuchPart(f"{option} {value:g}: points of a study are counted from 0.")
    chosen = range(int(start or 0), points if stop is None else min(int(stop), points))
    if not chosen:
        option = "stop" if start is None else "start"
        sentence = f"the study has points 0 to {points - 1}; there is none in this range."
        raise NoSuchPart(f"{option}: {sentence}")
    return chosen
