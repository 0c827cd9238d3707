"""A column of a table that goes into a file."""

from dataclasses import dataclass
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
    def is_number(self) -> bool:
        """Whether the values are numbers."""
        return self.values.dtype.kind in "fiub"
