"""Two bounds and the most probable value between them."""

from collections.abc import Iterator
from typing import Annotated, Literal

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.distributions.distribution import UNIT, Distribution
from jointplay.solver.quantities.units import quantity


class Triangular(Distribution):
    """A density that rises from `low` to `mode` and falls to `high`, on straight lines."""

    distribution: Literal["triangular"]
    low: Annotated[float, quantity(UNIT, description="least value")]
    mode: Annotated[float, quantity(UNIT, description="most probable value")]
    high: Annotated[float, quantity(UNIT, description="largest value")]

    def quantiles(self, shares: Floats) -> Floats:
        """Return quantiles; see `Distribution.quantiles`."""
        width, rise, fall = self.high - self.low, self.mode - self.low, self.high - self.mode
        rising = self.low + np.sqrt(shares * width * rise)
        falling = self.high - np.sqrt((1.0 - shares) * width * fall)
        return np.where(shares * width < rise, rising, falling)

    def problems(self) -> Iterator[tuple[str, str]]:
        """Yield what is wrong; see `Distribution.problems`."""
        yield from super().problems()
        if self.low < self.high and not self.low <= self.mode <= self.high:
            yield "mode", f"It lies between 'low', {self.low:g}, and 'high', {self.high:g}."
