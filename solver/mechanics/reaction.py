"""Action of a cut joint, from the multipliers of the rows that its type asks for."""

from collections.abc import Iterator, Mapping, Sequence

from jointplay.solver.joints.contact import Interaction
from jointplay.solver.joints.holding import Distance
from jointplay.solver.laws.force import Ends
from jointplay.solver.laws.function import Derivatives
from jointplay.solver.mechanics.closing_rows import Between
from jointplay.solver.quantities.frames import FrameVector, Pair, cross, plus, scaled
from jointplay.solver.quantities.scalars import Scalar


class Reaction:
    """The rows of a joint, each replaced by the action of its multiplier; see `Holding`."""

    def __init__(self, between: Between, multipliers: Mapping[str, Scalar]) -> None:
        """`multipliers` : N or N m, by part."""
        self.between = between
        self.multipliers = multipliers
        self.force: Pair = (0.0, 0.0)
        """On the second point, but for what is pushed along an axis of the first body, N."""
        self.pushed: FrameVector | None = None
        """The latter; the first body's point is elsewhere."""
        self.on_first: Scalar = 0.0
        self.on_second: Scalar = 0.0
        """Moments on the bodies, N m."""

    def interaction(self, first: str, second: str) -> Interaction:
        """Return the action between the joint's points."""
        force, on_first = self.force, self.on_first
        if self.pushed is not None:
            pushed = self.pushed.world()
            force = plus(force, pushed)
            on_first = on_first - cross(self.between.gap.world(), pushed)
        return Interaction(first, second, force, on_first, self.on_second)

    @property
    def ends(self) -> Ends:
        """The second point against the first."""
        return self.between.ends

    def coincident(self) -> Iterator[None]:
        """Yield once its two parts push."""
        self.force = plus(self.force, (self.multipliers["x"], self.multipliers["y"]))
        yield

    def across(self, axis: Sequence[Scalar]) -> None:
        """Push beside an axis."""
        self._push(self.between.direction(axis).turned().scaled(self.multipliers["normal"]))

    def along(self, axis: Sequence[Scalar], _motion: Derivatives) -> None:
        """Push along an axis."""
        self._push(self.between.direction(axis).scaled(self.multipliers["along"]))

    def at_angle(self, _angle: Scalar) -> None:
        """Turn one body against the other."""
        self.on_second = self.on_second + self.multipliers["angle"]
        self.on_first = self.on_first - self.multipliers["angle"]

    def turned(self, _motion: Derivatives) -> None:
        """Turn one body against the other."""
        self.at_angle(0.0)

    def apart(self, distance: Distance) -> None:
        """Push along the gradient of a distance."""
        held = self.multipliers["normal"]
        self.force = plus(self.force, scaled(distance.along, held))
        self.on_first = self.on_first + distance.on_first * held
        self.on_second = self.on_second + distance.on_second * held

    def _push(self, force: FrameVector) -> None:
        self.pushed = force if self.pushed is None else self.pushed + force
