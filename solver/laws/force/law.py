"""Interface of force elements."""

from abc import abstractmethod
from collections.abc import Mapping
from typing import ClassVar, NamedTuple

from jointplay.solver.quantities.scalars import Scalar
from jointplay.solver.quantities.units import PointReference, Rule, Strict


class Ends(NamedTuple):
    """How the second of two points lies and moves against the first, world components."""

    gap: tuple[Scalar, Scalar]
    """Position of the second point less that of the first, m."""
    rate: tuple[Scalar, Scalar]
    """Its rate, m/s."""
    spins: tuple[Scalar, Scalar]
    """Angular velocities of the first point's body and of the second's, rad/s."""
    turned: tuple[tuple[Scalar, Scalar], tuple[Scalar, Scalar]] = ((1.0, 0.0), (1.0, 0.0))
    """Cosine and sine of the angle of either body."""


class Effect(NamedTuple):
    """Action of an element at one instant. The power that goes into it is d(stored)/dt + loss."""

    force: tuple[Scalar, Scalar]
    """On the second point, N; its opposite acts on the first."""
    channels: Mapping[str, Scalar]
    """Values of the element's `channels`, by name."""
    stored: Scalar = 0.0
    """Energy that the element gives back, J."""
    loss: Scalar = 0.0
    """Power that is lost, W; negative where the element drives."""
    moment: Scalar = 0.0
    """On the second point's body, N m; its opposite acts on the first's."""


class ForceElement(Strict):
    """A force between two named points of different bodies, or of a body and the ground."""

    type: str
    first: PointReference
    second: PointReference
    rules: ClassVar[tuple[Rule, ...]] = ()
    """Rules that the parameters must keep."""
    channels: ClassVar[tuple[tuple[str, str, str], ...]] = ()
    """Name, unit and meaning of the channels that an element adds to a scene's."""

    @abstractmethod
    def effect(self, ends: Ends) -> Effect:
        """Return forces, energy and channels; arithmetic on abstract scalars."""

    @property
    def needs_direction(self) -> bool:
        """Whether the points must not start in one place, for the force has no direction there."""
        return False
