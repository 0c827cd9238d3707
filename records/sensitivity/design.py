"""A design of points: rows that count only whole, and the measures that they give."""

from abc import ABC, abstractmethod
from typing import ClassVar, NamedTuple

from jointplay.records.arrays import Floats


class Measure(NamedTuple):
    """A number that a design gives of each parameter."""

    long_name: str
    in_unit_of_output: bool = False
    """Else it is a pure number."""


class Design(ABC):
    """A member of `records.sensitivity.DESIGNS`.

    Its measures follow from means of moments over rows, so that all resamples of a bootstrap are
    one product of matrices.
    """

    measures: ClassVar[dict[str, Measure]]

    @abstractmethod
    def width(self, parameters: int) -> int:
        """Return the points of a row."""

    @abstractmethod
    def drawn(self, parameters: int) -> tuple[int, ...]:
        """Return which points of a row are a sample of the distributions; none: no quantiles."""

    @abstractmethod
    def moments(self, values: Floats, outputs: Floats) -> Floats:
        """Return (rows, moments) of rows that are whole.

        Parameters
        ----------
        values
            (rows, width, parameters).
        outputs
            (rows, width), about their mean.
        """

    @abstractmethod
    def measured(self, means: Floats, parameters: int) -> dict[str, Floats]:
        """Return (..., parameters) of each measure from (..., moments) means over rows.

        NaN where the output does not vary.
        """
