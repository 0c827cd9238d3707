"""The normal distribution."""

from typing import Annotated, ClassVar, Literal

from jointplay.records.arrays import Floats
from jointplay.solver.distributions.distribution import UNIT, Distribution
from jointplay.solver.distributions.standard_normal import quantiles
from jointplay.solver.quantities.units import quantity


class Normal(Distribution):
    """About a mean, without bounds."""

    distribution: Literal["normal"]
    mean: Annotated[float, quantity(UNIT, description="mean")]
    standard_deviation: Annotated[float, quantity(UNIT, description="standard deviation")]
    above_zero: ClassVar = ("standard_deviation",)

    def ends(self) -> tuple[str, ...]:
        """Return none."""
        return ()

    def quantiles(self, shares: Floats) -> Floats:
        """Return quantiles; see `Distribution.quantiles`."""
        return self.mean + self.standard_deviation * quantiles(shares)
