"""Interface of force elements."""

from abc import abstractmethod
from collections.abc import Mapping
from typing import ClassVar, Literal, NamedTuple

from jointplay.solver.quantities.scalars import Scalar
from jointplay.solver.quantities.units import Name, PointReference, Rule, Strict


class Ends(NamedTuple):
    """Place and motion of the second of two points against the first, world components."""

    gap: tuple[Scalar, Scalar]
    """Position of the second point less that of the first, m."""
    rate: tuple[Scalar, Scalar]
    """Rate of the gap, m/s."""
    spins: tuple[Scalar, Scalar]
    """Angular velocities of the first point's body and of the second's, rad/s."""
    turned: tuple[tuple[Scalar, Scalar], tuple[Scalar, Scalar]] = ((1.0, 0.0), (1.0, 0.0))
    """Cosine and sine of the angle of either body."""
    angles: tuple[Scalar, Scalar] = (0.0, 0.0)
    """These angles, rad; whole turns count."""
    argument: Scalar = 0.0
    """Argument of an element that varies; see `Over`."""
    argument_rate: Scalar = 0.0
    """Rate of the argument, where that is not a rate itself."""


class Effect(NamedTuple):
    """Action of an element at one instant. The power that goes into it is d(stored)/dt + loss."""

    force: tuple[Scalar, Scalar]
    """Force on the second point, N; its opposite acts on the first."""
    channels: Mapping[str, Scalar]
    """Values of the element's `channels`, by name."""
    stored: Scalar = 0.0
    """Energy that the element gives back, J."""
    loss: Scalar = 0.0
    """Power that is lost, W; negative where the element drives."""
    moment: Scalar = 0.0
    """Moment on the second point's body, N m; its opposite acts on the first's."""
    couple: Scalar = 0.0
    """Moment on the first point's body besides, N m: of a force not along the line between."""


class Over(Strict):
    """Argument of a strength: time (s), a driver's position, or the positions of two points.

    Of two points, by default the element's own: `angle` of the second's body less that of the
    first's (rad, whole turns count), `distance`, or `x` and `y` of the second less the first (m,
    world axes). With `rate` it is the rate of that instead.
    """

    quantity: Literal["time", "driver", "angle", "distance", "x", "y"] = "time"
    driver: Name | None = None
    first: PointReference | None = None
    second: PointReference | None = None
    rate: bool = False


class ForceElement(Strict):
    """A force between two named points of different bodies, or of a body and the ground."""

    type: str
    first: PointReference
    second: PointReference
    rules: ClassVar[tuple[Rule, ...]] = ()
    """Rules that the parameters must keep."""
    channels: ClassVar[tuple[tuple[str, str, str], ...]] = ()
    """Name, unit and meaning of the channels that an element adds to a scene's."""
    is_moment: ClassVar[bool] = False
    """Whether it is a moment alone: then it moves only what turns."""

    @abstractmethod
    def effect(self, ends: Ends) -> Effect:
        """Return forces, energy and channels; arithmetic on abstract scalars."""

    def follows(self) -> Over | None:
        """Return what the element is a function of besides its ends, if it varies."""
        return None

    def turns_counted(self) -> tuple[str, str] | None:
        """Return the points whose bodies' angle it follows, whole turns counted, if it does."""
        return None

    @property
    def fastest(self) -> float:
        """Largest angular velocity that it drives to by itself, rad/s; 0 if it has none."""
        return 0.0

    def strength(self, length: float) -> float:
        """Return a scale of its force, N; a moment acts at a `length`, m; 0: none is known."""
        return 0.0

    @property
    def needs_direction(self) -> bool:
        """True if the points must not coincide at the start: the force has no direction there."""
        return False
