"""A column of a table that goes into a file."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from typing import Any

from numpy.typing import NDArray


@dataclass(frozen=True)
class Column:
    """A quantity over the rows of a table, or with `part` its minimum or maximum.

    `values` are numbers or words; `unit` is empty where there is none.
    """

    name: str
    unit: str
    values: NDArray[Any]
    part: str = ""

    @property
    def label(self) -> str:
        """Name in flat tables."""
        return f"{self.name}_{self.part}" if self.part else self.name

    @property
    def title(self) -> str:
        """Name and unit, for the head of a table."""
        return f"{self.label} [{self.unit}]" if self.unit else self.label

    @property
    def is_number(self) -> bool:
        """Whether the values are numbers."""
        return self.values.dtype.kind in "fiub"


def apart(columns: Sequence[Column], taken: Collection[str] = ()) -> list[Column]:
    """Return columns of which no two have one label, nor one that is `taken`: they are numbered."""
    known, found = {*taken}, []
    for column in columns:
        own, number = column, 1
        while own.label in known:
            number += 1
            own = replace(column, name=f"{column.name}_{number}")
        known.add(own.label)
        found.append(own)
    return found
