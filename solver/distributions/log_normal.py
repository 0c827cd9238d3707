"""A normal distribution of the logarithm."""

from typing import Annotated, Literal

from jointplay.records.arrays import Floats
from jointplay.solver.distributions.distribution import UNIT, Distribution
from jointplay.solver.distributions.standard_normal import quantiles
from jointplay.solver.quantities.elementary import exp
from jointplay.solver.quantities.units import quantity


class LogNormal(Distribution):
    """Values above zero whose logarithm is normal about that of the median."""

    distribution: Literal["log-normal"]
    median: Annotated[float, quantity(UNIT, gt=0.0, description="median")]
    standard_deviation: Annotated[
        float,
        quantity("1", gt=0.0, le=10.0, description="standard deviation of the natural logarithm"),
    ]

    def ends(self) -> tuple[str, ...]:
        """Return none."""
        return ()

    def quantiles(self, shares: Floats) -> Floats:
        """Return quantiles; see `Distribution.quantiles`."""
        found: Floats = self.median * exp(self.standard_deviation * quantiles(shares))
        return found
