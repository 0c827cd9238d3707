"""A distribution that a parameter may have."""

from abc import abstractmethod
from collections.abc import Iterator
from typing import ClassVar

from jointplay.records.arrays import Floats
from jointplay.solver.quantities.units import Strict

UNIT = "the parameter's unit"


class Distribution(Strict):
    """A member of `solver.distributions.DISTRIBUTIONS`; its tag is the field ``distribution``.

    Quantiles are own arithmetic: the same bits wherever they are computed.
    """

    above_zero: ClassVar[tuple[str, ...]] = ()
    """Fields that must be."""

    @abstractmethod
    def quantiles(self, shares: Floats) -> Floats:
        """Return the values below which lie shares of the probability, each above 0 and below 1."""

    def ends(self) -> tuple[str, ...]:
        """Return the fields between which all values lie; none where there is no such bound."""
        return ("low", "high")

    def problems(self) -> Iterator[tuple[str, str]]:
        """Yield a field and what is wrong with it: its sign, or that another does not fit."""
        for field in self.above_zero:
            if not getattr(self, field) > 0.0:
                yield field, f"It is {getattr(self, field):g}; it must be above zero."
        low, high = getattr(self, "low", None), getattr(self, "high", None)
        if low is not None and high is not None and not low < high:
            yield "high", f"{high:g} is not above 'low', {low:g}; all values lie between them."
