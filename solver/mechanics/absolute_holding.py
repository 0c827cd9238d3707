"""The rows of one joint in absolute coordinates, as its type asks for them."""

from collections.abc import Iterator, Sequence

from jointplay.solver.joints.holding import Distance
from jointplay.solver.joints.starts import GuideStart, JournalStart
from jointplay.solver.laws.force import Ends
from jointplay.solver.laws.function import Derivatives
from jointplay.solver.mechanics.rows import (
    RESTING,
    Marker,
    Row,
    angle_row,
    distance_row,
    projection_row,
)
from jointplay.solver.quantities.frames import Pair, left, minus, unit
from jointplay.solver.quantities.scalars import Scalar, sine_cosine

CONCENTRIC = JournalStart()
CENTRED = GuideStart()


def ends_of(first: Marker, second: Marker, angles: tuple[Scalar, Scalar]) -> Ends:
    """Return how the second of two points lies and moves against the first."""
    return Ends(
        minus(second.position, first.position),
        minus(second.velocity, first.velocity),
        (first.spin, second.spin),
        (first.turned, second.turned),
        angles,
    )


class AbsoluteHolding:
    """A joint between markers; with play, it is held where it starts."""

    def __init__(
        self,
        name: str,
        markers: tuple[Marker, Marker],
        journal: JournalStart,
        guided: GuideStart,
    ) -> None:
        self.name = name
        self.first, self.second = markers
        self.journal, self.guided = journal, guided

    @property
    def ends(self) -> Ends:
        """The second point against the first."""
        return ends_of(self.first, self.second, (self.first.angle, self.second.angle))

    def coincident(self) -> Iterator[Row]:
        """Yield r_second - r_first - e = 0, e as the start says; it stays if no rate is given."""
        offset, moving = self.journal.eccentricity, self.journal.rate or (0.0, 0.0)
        first, second = self.first, self.second
        for axis, part in ((0, "x"), (1, "y")):
            jacobian: dict[int, Scalar] = {}
            gamma: Scalar = 0.0
            for sign, marker in ((1.0, second), (-1.0, first)):
                if marker.body < 0:
                    continue
                jacobian[3 * marker.body + axis] = sign
                turn = -marker.arm[1] if axis == 0 else marker.arm[0]
                jacobian[3 * marker.body + 2] = sign * turn
                gamma = gamma + sign * (marker.spin * marker.spin) * marker.arm[axis]
            yield Row(
                self.name,
                part,
                second.position[axis] - first.position[axis] - offset[axis],
                jacobian,
                second.velocity[axis] - first.velocity[axis] - moving[axis],
                gamma,
            )

    def across(self, axis: Sequence[Scalar]) -> Row:
        """Return the row of a point that stays beside an axis."""
        start, normal = self.guided, left(self._turned(axis))
        aside = RESTING._replace(value=start.offset, slope=start.rate or 0.0)
        return projection_row(self.name, "normal", normal, aside, self.first, self.second)

    def along(self, axis: Sequence[Scalar], motion: Derivatives) -> Row:
        """Return the row of a point that moves along an axis."""
        direction = self._turned(axis)
        return projection_row(self.name, "along", direction, motion, self.first, self.second)

    def at_angle(self, angle: Scalar) -> Row:
        """Return the row of an angle that stays."""
        start = self.guided
        held = angle + start.tilt if start.tilt else angle
        motion = RESTING._replace(value=held, slope=start.tilt_rate or 0.0)
        return angle_row(self.name, self.first, self.second, motion)

    def turned(self, motion: Derivatives) -> Row:
        """Return the row of a prescribed angle."""
        return angle_row(self.name, self.first, self.second, motion)

    def apart(self, distance: Distance) -> Row:
        """Return the row of a distance."""
        start = self.guided
        if start.offset or start.rate:
            distance = distance.less(start.offset, start.rate or 0.0)
        return distance_row(self.name, self.first, self.second, distance)

    def _turned(self, axis: Sequence[Scalar]) -> Pair:
        return world_axis(axis, self.first)


def world_axis(axis: Sequence[Scalar], guide: Marker) -> Pair:
    """Return the unit vector of a guide's axis in world components."""
    x, y = unit(axis)
    if guide.body < 0:
        return x, y
    sine, cosine = sine_cosine(guide.angle)
    return cosine * x - sine * y, sine * x + cosine * y
