"""Interface of contact laws."""

import math
from abc import abstractmethod
from typing import ClassVar

from jointplay.solver.laws.contact.film import Film, Pair
from jointplay.solver.laws.fit import Fit
from jointplay.solver.quantities.scalars import Scalar
from jointplay.solver.quantities.units import Rule, Strict


class ContactLaw(Strict):
    """The force along the normal where a journal touches its bearing.

    Depth is the penetration where positive, m; its rate is positive while approaching, m/s. The
    force must vanish with the depth, or name that as the obstacle to tangents.
    """

    law: str
    rules: ClassVar[tuple[Rule, ...]] = ()
    """Rules that the parameters must keep."""
    is_film: ClassVar[bool] = False
    """Whether oil acts between journal and bearing, touching or apart."""

    @abstractmethod
    def normal_force(self, fit: Fit, depth: Scalar, rate: Scalar, impact_rate: Scalar) -> Scalar:
        """Return the normal force, N, never negative.

        `impact_rate` is the rate at the onset of this contact, at least `least_impact_rate`, m/s.
        """

    @abstractmethod
    def elastic_energy(self, fit: Fit, depth: Scalar) -> Scalar:
        """Return the energy stored at a depth, J: what the force at rest gives back."""

    def film(self, fit: Fit, eccentricity: Pair, rate: Pair, spins: Pair) -> Film | None:
        """Return what oil between journal and bearing exerts, touching or apart, if there is any.

        `eccentricity` (m) and its `rate` (m/s) in the world's axes, `spins` of bearing and journal
        (rad/s).
        """
        return None

    def deepest(self, fit: Fit) -> Scalar:
        """Return the depth up to which the law is what its source says, m."""
        return math.inf

    def idle_beside(self) -> tuple[str, tuple[str, ...]]:
        """Return a field, and those that have no effect beside it as it is given."""
        return "", ()

    @property
    def clearance_rules(self) -> tuple[Rule, ...]:
        """Rules that a clearance with this law must keep."""
        return ()

    @property
    def title(self) -> str:
        """Name of the law in sentences."""
        return self.law

    @property
    def least_impact_rate(self) -> float | None:
        """Floor under the impact rate that an onset latches, m/s.

        0 for laws without memory; none: a share of the scene's speed.
        """
        return 0.0

    @property
    def needs_radii(self) -> bool:
        """True if the force depends on the radii of journal and bearing, which a wall has not."""
        return True

    @property
    def jumps_at_onset(self) -> bool:
        """True if the force is there at once where a contact begins."""
        return False

    @property
    def tangent_obstacle(self) -> str:
        """Reason why no tangent vector follows a run with this law, with the remedy, or nothing."""
        return ""
