"""An estimated number with its standard error."""

import math
from dataclasses import dataclass

SIGNIFICANT = 3.0
"""Errors by which a number must differ from another to count as different: by chance one in 370
does."""


@dataclass(frozen=True)
class Estimate:
    """A number estimated from a record of finite length, with its standard error.

    `value` and `error` have the same unit; an infinite error is that of a number about which the
    record says nothing. `drifting`: the two halves of the record differ significantly, so a longer
    record would give another value; the error then covers the difference.

    Raises
    ------
    ValueError
        If the error is negative or NaN.
    """

    value: float
    error: float
    drifting: bool = False

    def __post_init__(self) -> None:
        if not self.error >= 0.0:
            raise ValueError(f"an error is zero, positive or infinite, not {self.error}")

    def exceeds(self, bound: float) -> bool:
        """Return whether the value lies above a bound by more than `SIGNIFICANT` errors."""
        return self.value - bound > SIGNIFICANT * self.error

    def falls_below(self, bound: float) -> bool:
        """Return whether the value lies below a bound by more than `SIGNIFICANT` errors."""
        return bound - self.value > SIGNIFICANT * self.error

    def __str__(self) -> str:
        """Return value ± error, the error with two digits and the value to the same place."""
        if not math.isfinite(self.value) or not 1e-5 < self.error < math.inf:
            return f"{self.value:.6g} ± {self.error:.2g}"
        place = max(1 - math.floor(math.log10(self.error)), 0)
        return f"{self.value:.{place}f} ± {self.error:.{place}f}"


UNKNOWN = Estimate(math.nan, math.inf)
"""The estimate from a record that is too short."""
