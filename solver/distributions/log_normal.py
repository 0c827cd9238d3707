"""A normal distribution of the logarithm."""

from typing import Annotated, ClassVar, Literal

from jointplay.records.arrays import Floats
from jointplay.solver.distributions.distribution import UNIT, Distribution
from jointplay.solver.distributions.standard_normal import quantiles
from jointplay.solver.quantities.elementary import exp
from jointplay.solver.quantities.units import quantity


class LogNormal(Distribution):
    """Values above zero whose logarithm is normal about that of the median."""

    distribution: Literal["log-normal"]
    median: Annotated[float, quantity(UNIT, description="median")]
    standard_deviation: Annotated[
        float,
        quantity("1", le=10.0, description="standard deviation of the natural logarithm"),
    ]
    above_zero: ClassVar = ("median", "standard_deviation")

    def ends(self) -> tuple[str, ...]:
        """Return none."""
        return ()

    def quantiles(self, shares: Floats) -> Floats:
        """Return quantiles; see `Distribution.quantiles`."""
        found: Floats = self.median * exp(self.standard_deviation * quantiles(shares))
        return found
