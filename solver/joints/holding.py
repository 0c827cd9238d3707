"""Kinds of constraints that hold a joint, in whichever formulation writes them."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple, Protocol, TypeVar

from jointplay.solver.laws.force import Ends
from jointplay.solver.laws.function import Derivatives
from jointplay.solver.quantities.frames import Pair
from jointplay.solver.quantities.scalars import Scalar

Row = TypeVar("Row", covariant=True)


class Distance(NamedTuple):
    """A length that a joint keeps at zero, as a function of how its ends lie.

    Its rate is along · ġ + on_first ω_1 + on_second ω_2, with g from the first point to the second;
    its second derivative is the same of the accelerations, plus `bias`.
    """

    value: Scalar
    """The distance, positive apart, m."""
    along: Pair
    """Its gradient by the gap, in the world's axes."""
    on_first: Scalar
    """Its derivative by the first body's angle, m."""
    on_second: Scalar
    """Its derivative by the second body's angle, m."""
    rate: Scalar
    """Its rate, m/s."""
    bias: Scalar
    """Its second derivative without accelerations, m/s^2."""

    def less(self, distance: float, rate: float) -> "Distance":
        """Return it from where the ends are a distance, m, away, and its rate, m/s."""
        return self._replace(value=self.value - distance, rate=self.rate - rate)


class Holding(Protocol[Row]):
    """A formulation that is asked for the constraints of one joint.

    Axes are directions in the first body's axes, of any length. Where a joint with play is held as
    the start says, the formulation adds that.
    """

    @property
    def ends(self) -> Ends:
        """The second point against the first."""

    def coincident(self) -> Iterator[Row]:
        """Yield the parts `x` and `y`: both points are one."""

    def across(self, axis: Sequence[Scalar]) -> Row:
        """Return the part `normal`: the second point stays on the axis through the first."""

    def along(self, axis: Sequence[Scalar], motion: Derivatives) -> Row:
        """Return the part `along`: the second point moves along the axis as prescribed, m."""

    def at_angle(self, angle: Scalar) -> Row:
        """Return the part `angle`: the second body's angle less the first's stays, rad."""

    def turned(self, motion: Derivatives) -> Row:
        """Return the part `angle`: the second body turns against the first as prescribed, rad."""

    def apart(self, distance: Distance) -> Row:
        """Return the part `normal`: a distance stays zero."""
