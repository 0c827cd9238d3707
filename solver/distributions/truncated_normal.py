"""The normal distribution between two bounds."""

from collections.abc import Iterator
from typing import Annotated, ClassVar, Literal

from jointplay.records.arrays import Floats
from jointplay.solver.distributions.distribution import UNIT, Distribution
from jointplay.solver.distributions.standard_normal import quantiles, share_below
from jointplay.solver.quantities.units import quantity

FARTHEST = 8.0
"""Standard deviations that a bound may lie beyond the mean."""


class TruncatedNormal(Distribution):
    """A normal distribution of which only what lies between `low` and `high` is left."""

    distribution: Literal["truncated-normal"]
    mean: Annotated[float, quantity(UNIT, description="mean before truncation")]
    standard_deviation: Annotated[
        float, quantity(UNIT, description="standard deviation before truncation")
    ]
    low: Annotated[float, quantity(UNIT, description="least value")]
    high: Annotated[float, quantity(UNIT, description="largest value")]
    above_zero: ClassVar = ("standard_deviation",)

    def quantiles(self, shares: Floats) -> Floats:
        """Return quantiles; see `Distribution.quantiles`."""
        low, high = self._reduced()
        if low > 0.0:  # the upper tail has no digits left near one: the lower one has them all
            found = -self._between(-high, -low, 1.0 - shares)
        else:
            found = self._between(low, high, shares)
        values = self.mean + self.standard_deviation * found
        return values.clip(self.low, self.high)

    def problems(self) -> Iterator[tuple[str, str]]:
        """Yield what is wrong; see `Distribution.problems`."""
        yield from super().problems()
        if not self.standard_deviation > 0.0:
            return
        low, high = self._reduced()
        for field, apart in (("low", low), ("high", -high)):
            if apart > FARTHEST:
                many = f"{apart:.3g} standard deviations beyond the mean"
                yield field, f"It is {many}; it may be {FARTHEST:g} at most."

    def _reduced(self) -> tuple[float, float]:
        low, high = ((end - self.mean) / self.standard_deviation for end in (self.low, self.high))
        return low, high

    def _between(self, low: float, high: float, shares: Floats) -> Floats:
        below = share_below(low)
        return quantiles(below + shares * (share_below(high) - below))
