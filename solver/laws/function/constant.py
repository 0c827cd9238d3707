"""A constant."""

from typing import Annotated, Literal

from jointplay.solver.laws.function.law import Derivatives, Function
from jointplay.solver.quantities.scalars import Scalar
from jointplay.solver.quantities.units import quantity


class Constant(Function):
    """f(x) = value.

    Assumes nothing. Fails nowhere.

    Source: the definition of a constant.
    """

    type: Literal["constant"]
    value: Annotated[float, quantity("unit of the value", ge=-1e12, le=1e12)]

    def at(self, x: Scalar) -> Derivatives:
        """Return the value."""
        return Derivatives(self.value, 0.0, 0.0)

    @property
    def period(self) -> float:
        """Nothing."""
        return 0.0

    def largest(self, until: float) -> list[float]:
        """Return nothing: there is no derivative."""
        return []
