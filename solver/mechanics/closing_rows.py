"""Equations of joints that close loops, in the coordinates of the spanning tree."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from jointplay.solver.joints.holding import Distance
from jointplay.solver.laws.force import Ends
from jointplay.solver.laws.function import Derivatives
from jointplay.solver.laws.function.whole_turn import TURN
from jointplay.solver.mechanics.elimination import is_zero
from jointplay.solver.mechanics.kinematics import Kinematics
from jointplay.solver.mechanics.rows import RESTING
from jointplay.solver.quantities.frames import WORLD, FrameVector, unit
from jointplay.solver.quantities.scalars import Scalar, floor, sine_cosine


@dataclass(frozen=True)
class ClosingRow:
    """One equation of a cut joint: Φ (m, or the sine of an angle), its rate and its Jacobian.

    `partials` by coordinate, without zeros; Φ̈ = Σ partial q̈ + `bias`.
    """

    joint: str
    part: str
    value: Scalar
    rate: Scalar
    partials: dict[str, Scalar]
    bias: Scalar


class Between:
    """A cut joint's second point against its first."""

    def __init__(self, kinematics: Kinematics, joint: str) -> None:
        k = self.kinematics = kinematics
        self.joint = joint
        here, there = k.numbers.joints[joint].points
        (self.first, p), (self.second, q) = here.split("."), there.split(".")
        arms = k.arm(self.first, p), k.arm(self.second, q)
        start, start_rate, start_partials = k.point_motion(self.first, arms[0])
        end, end_rate, end_partials = k.point_motion(self.second, arms[1])
        self.gap = end + start.scaled(-1.0)
        self.rate = end_rate + start_rate.scaled(-1.0)
        start_bias = k.point_bias(self.first, arms[0])
        self.bias = k.point_bias(self.second, arms[1]) + start_bias.scaled(-1.0)
        self.partials: dict[str, FrameVector] = {}
        for name in k.tree.coordinates:
            parts = [end_partials[name]] if name in end_partials else []
            if name in start_partials:
                parts.append(start_partials[name].scaled(-1.0))
            if parts:
                self.partials[name] = parts[0] + parts[1] if len(parts) > 1 else parts[0]

    def coincident(self) -> Iterator[ClosingRow]:
        """Yield the rows of two points that are one, x and y in the world's axes."""
        (x, y), (vx, vy), (ax, ay) = self.gap.world(), self.rate.world(), self.bias.world()
        partials = {name: partial.world() for name, partial in self.partials.items()}
        yield self._row("x", x, vx, {name: px for name, (px, _) in partials.items()}, ax)
        yield self._row("y", y, vy, {name: py for name, (_, py) in partials.items()}, ay)

    def across(self, axis: Sequence[Scalar]) -> ClosingRow:
        """Return the row of a point that stays on an axis of the first body."""
        return self._projection("normal", self.direction(axis).turned(), RESTING)

    def along(self, axis: Sequence[Scalar], motion: Derivatives) -> ClosingRow:
        """Return the row of a point that moves along an axis of the first body."""
        return self._projection("along", self.direction(axis), motion)

    def direction(self, axis: Sequence[Scalar]) -> FrameVector:
        """Return the unit vector of an axis, fixed in the first body."""
        return FrameVector(self.kinematics.orientations, {self.first: unit(axis)})

    def at_angle(self, angle: Scalar) -> ClosingRow:
        """Return the row of an angle between the bodies that stays."""
        return self.turned(RESTING._replace(value=angle))

    def _projection(self, part: str, direction: FrameVector, motion: Derivatives) -> ClosingRow:
        """Return the row of a gap, along a direction of the first body, that is the travel."""
        guide = self.kinematics.carried[self.first]
        turned, spin = direction.turned(), guide.spin
        sideways = turned.dot(self.gap)
        partials = {name: direction.dot(partial) for name, partial in self.partials.items()}
        for name, share in guide.spin_partials.items():
            partials[name] = partials.get(name, 0.0) + share * sideways
        along = direction.dot(self.gap)
        bias = direction.dot(self.bias) + 2.0 * (spin * turned.dot(self.rate))
        if not is_zero(guide.spin_bias):
            bias = bias + guide.spin_bias * sideways
        return self._row(
            part,
            along - motion.value,
            direction.dot(self.rate) + spin * sideways - motion.slope,
            partials,
            bias - (spin * spin) * along - motion.curvature,
        )

    @property
    def ends(self) -> Ends:
        """The second point against the first, whole turns left out."""
        bodies = self.first, self.second
        one, two = (self.kinematics.carried[body] for body in bodies)
        first, second = (self.kinematics.orientations.cosine_sine[body] for body in bodies)
        return Ends(
            self.gap.world(),
            self.rate.world(),
            (one.spin, two.spin),
            (first, second),
            (one.angle, two.angle),
        )

    def apart(self, distance: Distance) -> ClosingRow:
        """Return the row of a distance that stays zero."""
        along = FrameVector(self.kinematics.orientations, {WORLD: distance.along})
        partials = {name: along.dot(partial) for name, partial in self.partials.items()}
        bias = distance.bias + along.dot(self.bias)
        for body, turning in ((self.first, distance.on_first), (self.second, distance.on_second)):
            frame = self.kinematics.carried[body]
            bias = bias + turning * frame.spin_bias
            for name, share in frame.spin_partials.items():
                partials[name] = partials.get(name, 0.0) + turning * share
        return self._row("normal", distance.value, distance.rate, partials, bias)

    def turned(self, motion: Derivatives) -> ClosingRow:
        """Return the row of an angle between the bodies as prescribed, but for whole turns."""
        one, two = (self.kinematics.carried[body] for body in (self.first, self.second))
        cosine, sine = self.kinematics.orientations.between(self.first, self.second)
        sine_offset, cosine_offset = sine_cosine(motion.value)
        partials = dict(two.spin_partials)
        for name, share in one.spin_partials.items():
            partials[name] = partials.get(name, 0.0) - share
        value = sine * cosine_offset - cosine * sine_offset
        bias = two.spin_bias - one.spin_bias - motion.curvature
        return self._row("angle", value, two.spin - one.spin - motion.slope, partials, bias)

    def _row(
        self, part: str, value: Scalar, rate: Scalar, partials: dict[str, Scalar], bias: Scalar
    ) -> ClosingRow:
        names = self.kinematics.tree.coordinates
        found = {n: p for n, p in partials.items() if n in names and not is_zero(p)}
        return ClosingRow(self.joint, part, value, rate, found, bias)


def closing_rows(kinematics: Kinematics) -> list[ClosingRow]:
    """Return the equations of all cut joints, in the order of the document."""
    numbers = kinematics.numbers
    drivers = {driver.joint: name for name, driver in numbers.drivers.items()}
    rows: list[ClosingRow] = []
    for name in kinematics.tree.closing:
        if name in numbers.gears:
            rows.append(_gear_row(kinematics, name))
            continue
        motion = kinematics.moved[drivers[name]] if name in drivers else None
        rows += numbers.joints[name].rows(Between(kinematics, name), motion)
    return rows


def _gear_row(kinematics: Kinematics, name: str) -> ClosingRow:
    """Return α_2 - ratio α_1 - offset = 0, but for whole turns of the second joint."""
    gear, names = kinematics.numbers.gears[name], kinematics.tree.coordinates
    partials: dict[str, Scalar] = {}
    value: Scalar = -gear.offset
    rate: Scalar = 0.0
    bias: Scalar = 0.0
    for factor, body in gear.coupled(kinematics.numbers.joints):
        frame = kinematics.carried[body]
        value, rate = value + factor * kinematics.whole_angle(body), rate + factor * frame.spin
        bias = bias + factor * frame.spin_bias
        for coordinate, share in frame.spin_partials.items():
            partials[coordinate] = partials.get(coordinate, 0.0) + factor * share
    found = {n: p for n, p in partials.items() if n in names and not is_zero(p)}
    value = value - TURN * floor(value / TURN + 0.5)
    return ClosingRow(name, "angle", value, rate, found, bias)
