"""A journal in its bearing, as contact laws see it."""

from typing import Protocol

from jointplay.solver.quantities.scalars import Scalar


class Fit(Protocol):
    """A journal in its bearing."""

    @property
    def bearing_radius(self) -> Scalar:
        """Radius of the bearing, m."""

    @property
    def radial_clearance(self) -> Scalar:
        """The bearing's radius less the journal's, m."""

    @property
    def bearing_width(self) -> Scalar:
        """Length of the bearing along its axis, m; None where it is not given."""
