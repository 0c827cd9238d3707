"""All values between two alike."""

from typing import Annotated, Literal

from jointplay.records.arrays import Floats
from jointplay.solver.distributions.distribution import UNIT, Distribution
from jointplay.solver.quantities.units import quantity


class Uniform(Distribution):
    """Every value between `low` and `high` is as probable."""

    distribution: Literal["uniform"]
    low: Annotated[float, quantity(UNIT, description="least value")]
    high: Annotated[float, quantity(UNIT, description="largest value")]

    def quantiles(self, shares: Floats) -> Floats:
        """Return quantiles; see `Distribution.quantiles`."""
        return self.low + shares * (self.high - self.low)
