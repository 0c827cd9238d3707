"""Printed numbers beside ours: the tables of the report."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import groupby
from typing import Final

_GRADES: Final = {"same": 0.02, "close": 0.15, "order": 0.5}
"""Deviations up to which ours are called the same, close, or of the same order."""


@dataclass(frozen=True)
class Cell:
    """One reading's result: a main line, smaller ones below, and ours over the printed one."""

    main: str
    details: tuple[str, ...] = ()
    ratio: float | None = None

    @property
    def grade(self) -> str:
        """Nearness of ours in one word; empty where there is nothing to compare."""
        if self.ratio is None:
            return ""
        deviation = abs(self.ratio - 1.0)
        return next((word for word, bound in _GRADES.items() if deviation <= bound), "far")


@dataclass(frozen=True)
class Row:
    """One printed number, or several that belong together, beside ours.

    `pointers` are the locations of the numbers in `reported_values.json`; `causes` name sections of
    the report that say why ours may differ.
    """

    pointers: tuple[str, ...]
    case: str
    quantity: str
    printed: str
    cells: tuple[Cell, ...]
    causes: tuple[str, ...] = ()


@dataclass(frozen=True)
class Table:
    """A table of comparisons.

    Parameters
    ----------
    columns
        Titles of the columns for ours.
    first
        Titles of the columns for case, quantity and printed numbers.
    """

    caption: str
    columns: Sequence[str]
    rows: Sequence[Row]
    first: Sequence[str] = ("case", "quantity", "printed")

    @property
    def titles(self) -> list[str]:
        """The titles of all columns."""
        return [*self.first, *self.columns, "why"]

    @property
    def groups(self) -> list[list[Row]]:
        """The rows, those of one case together."""
        return [list(rows) for _, rows in groupby(self.rows, lambda row: row.case)]


def milliseconds(time: float) -> str:
    """Return a time [s] in ms."""
    return f"{1e3 * time:.4g} ms"


def small(value: float, bound: float) -> str:
    """Return a number with two digits, or 0 if its magnitude is below a bound."""
    return "0" if abs(value) < bound else signed(value, ".2g")


def signed(value: float, digits: str) -> str:
    """Return a number with a minus sign as wide as a digit, that no line is broken after."""
    written = format(value, digits)
    return written.removeprefix("-") if float(written) == 0.0 else written.replace("-", "−")
