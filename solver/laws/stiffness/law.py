"""Interface of stiffness laws: the force at rest over the depth, and what it stores."""

import math
from abc import abstractmethod
from typing import ClassVar

from jointplay.solver.laws.fit import Fit
from jointplay.solver.quantities.scalars import Scalar
from jointplay.solver.quantities.units import Rule, Strict


class Stiffness(Strict):
    """The elastic force where a journal touches its bearing.

    Depth is the penetration, m. Force, energy and slope are zero where it is not positive.
    """

    law: str
    rules: ClassVar[tuple[Rule, ...]] = ()
    """Rules that the parameters must keep."""
    fit_rules: ClassVar[tuple[Rule, ...]] = ()
    """Rules that a clearance with this law must keep."""
    needs_radii: ClassVar[bool] = True
    """True if the force depends on the radii of journal and bearing, which a wall has not."""

    @abstractmethod
    def force(self, fit: Fit, depth: Scalar) -> Scalar:
        """Return the force, N: it grows with the depth, from zero."""

    @abstractmethod
    def energy(self, fit: Fit, depth: Scalar) -> Scalar:
        """Return the energy stored, J: the integral of the force over the depth."""

    @abstractmethod
    def slope(self, fit: Fit, depth: Scalar) -> Scalar:
        """Return the derivative of the force, N/m."""

    def deepest(self, fit: Fit) -> Scalar:
        """Return the depth up to which the law is what its source says, m."""
        return math.inf

    @property
    def is_stiff_at_once(self) -> bool:
        """True if the slope does not set in from zero as a power of the depth does."""
        return False
