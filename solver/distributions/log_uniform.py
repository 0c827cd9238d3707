"""All magnitudes between two alike."""

from typing import Annotated, ClassVar, Literal

from jointplay.records.arrays import Floats
from jointplay.solver.distributions.distribution import UNIT, Distribution
from jointplay.solver.quantities.elementary import power
from jointplay.solver.quantities.units import quantity


class LogUniform(Distribution):
    """The logarithm is as probable everywhere between those of `low` and `high`."""

    distribution: Literal["log-uniform"]
    low: Annotated[float, quantity(UNIT, description="least value")]
    high: Annotated[float, quantity(UNIT, description="largest value")]
    above_zero: ClassVar = ("low", "high")

    def quantiles(self, shares: Floats) -> Floats:
        """Return quantiles; see `Distribution.quantiles`."""
        found: Floats = self.low * power(self.high / self.low, shares)
        return found.clip(self.low, self.high)
