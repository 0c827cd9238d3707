"""Kinematics over the spanning tree: each body's motion as a function of the coordinates.

Every body has a reference point, where its tree joint holds it. Partial velocities (Kane) follow
from the same walk: the velocity of a point is Σ partial_i u_i over the speeds u of the
coordinates and of the drivers, its acceleration Σ partial_i u̇_i + bias.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from jointplay.solver.mechanics.elimination import is_zero
from jointplay.solver.mechanics.tree import Branch, Tree
from jointplay.solver.quantities.frames import WORLD, FrameVector, Orientations, Pair, unit
from jointplay.solver.quantities.scalars import Scalar, sine_cosine
from jointplay.solver.scene.document import Scene


@dataclass
class Carried:
    """A body's frame, seen from the tree: angles in rad, lengths in m, SI rates."""

    body: str
    angle: Scalar
    spin: Scalar
    spin_partials: dict[str, Scalar]
    origin: FrameVector
    """Reference point, from the world's origin."""
    velocity: FrameVector
    bias: FrameVector
    """Acceleration of the reference point with all coordinate accelerations zero."""
    spin_bias: Scalar
    """Angular acceleration then: what drivers prescribe, rad/s^2."""
    partials: dict[str, FrameVector]
    hub: Pair
    """The reference point in body coordinates (origin at the centre of mass)."""


class Kinematics:
    """All bodies of a scene in motion."""

    def __init__(
        self,
        tree: Tree,
        numbers: Scene,
        position: Mapping[str, Scalar],
        speed: Mapping[str, Scalar],
        driven: Mapping[str, Scalar],
        wound: Mapping[str, Scalar] = MappingProxyType({}),
    ) -> None:
        """Walk the tree.

        `position` and `speed` by coordinate name; `driven` the clock of each driver; `wound` whole
        turns of bodies that the angles of drivers leave out, rad.
        """
        self.tree = tree
        self.wound = wound
        self.numbers = numbers
        self.orientations = Orientations()
        self.position = position
        self.driven = driven
        self.moved = {name: driver.at(driven[name]) for name, driver in numbers.drivers.items()}
        self.speed = {**speed, **{name: moved.slope for name, moved in self.moved.items()}}
        zero = FrameVector(self.orientations)
        ground = Carried(WORLD, 0.0, 0.0, {}, zero, zero, zero, 0.0, {}, (0.0, 0.0))
        self.carried: dict[str, Carried] = {WORLD: ground}
        for branch in tree.branches:
            self.carried[branch.body] = self._carry(branch)

    def whole_angle(self, body: str) -> Scalar:
        """Return the angle of a body, whole turns included, rad."""
        angle = self.carried[body].angle
        return angle + self.wound[body] if body in self.wound else angle

    def arm(self, body: str, point: str) -> FrameVector:
        """Return the vector from a body's reference point to a named point."""
        return self._arm(body, self._coordinates(body, point))

    def centre(self, body: str) -> FrameVector:
        """Return the vector from a body's reference point to its centre of mass."""
        return self._arm(body, (0.0, 0.0))

    def point_motion(
        self, body: str, arm: FrameVector
    ) -> tuple[FrameVector, FrameVector, dict[str, FrameVector]]:
        """Return position, velocity and partial velocities of a point of a body."""
        frame = self.carried[body]
        partials = dict(frame.partials)
        for name, rate in frame.spin_partials.items():
            swept = arm.turned().scaled(rate)
            partials[name] = partials[name] + swept if name in partials else swept
        velocity = frame.velocity + arm.turned().scaled(frame.spin)
        return frame.origin + arm, velocity, partials

    def point_bias(self, body: str, arm: FrameVector) -> FrameVector:
        """Return a point's acceleration with all coordinate accelerations zero."""
        frame = self.carried[body]
        bias = frame.bias + arm.scaled(-(frame.spin * frame.spin))
        if is_zero(frame.spin_bias):
            return bias
        return bias + arm.turned().scaled(frame.spin_bias)

    def _coordinates(self, body: str, point: str) -> Pair:
        part = self.numbers.ground if body == WORLD else self.numbers.bodies[body]
        x, y = part.points[point]
        return x, y

    def _arm(self, body: str, target: Pair) -> FrameVector:
        hub = self.carried[body].hub
        return FrameVector(self.orientations, {body: (target[0] - hub[0], target[1] - hub[1])})

    def _carry(self, branch: Branch) -> Carried:
        if branch.freedom == "all":
            return self._float(branch)
        parent = self.carried[branch.parent]
        hub = self._coordinates(branch.body, branch.body_point)
        arm = self.arm(branch.parent, branch.parent_point)
        origin, velocity, partials = self.point_motion(branch.parent, arm)
        bias = self.point_bias(branch.parent, arm)
        angle, spin, spin_partials = parent.angle, parent.spin, dict(parent.spin_partials)
        spin_bias = parent.spin_bias
        sense = 1.0 if branch.outward else -1.0
        joint = self.numbers.joints[branch.joint]
        if branch.freedom == "turn":
            if branch.turned_by is not None:
                angle, spin, spin_bias = self.moved[branch.turned_by]
                spin_partials = {branch.turned_by: 1.0}
            elif branch.driver is not None:
                moved = self.moved[branch.driver]
                angle = angle + sense * moved.value
                spin = spin + sense * moved.slope
                spin_bias = spin_bias + sense * moved.curvature
                spin_partials[branch.driver] = sense
            else:
                name = branch.coordinates[0]
                angle, spin = self.position[name], self.speed[name]
                spin_partials, spin_bias = {name: 1.0}, 0.0
        else:
            angle = angle + sense * joint.angle
        self._orient(branch.body, angle)
        if joint.heading is not None:
            name = branch.driver or branch.coordinates[0]
            travel = self.moved[name].value if branch.driver else self.position[name]
            guide = branch.parent if branch.outward else branch.body
            axis = FrameVector(self.orientations, {guide: unit(joint.heading)})
            path = axis.scaled(sense * travel)
            rate = axis.scaled(sense * self.speed[name])
            origin = origin + path
            velocity = velocity + rate + path.turned().scaled(spin)
            bias = bias + path.scaled(-(spin * spin)) + rate.turned().scaled(2.0 * spin)
            if not is_zero(spin_bias):
                bias = bias + path.turned().scaled(spin_bias)
            if branch.driver and not is_zero(self.moved[name].curvature):
                bias = bias + axis.scaled(sense * self.moved[name].curvature)
            for key, share in spin_partials.items():
                swept = path.turned().scaled(share)
                partials[key] = partials[key] + swept if key in partials else swept
            partials[name] = axis.scaled(sense)
        return Carried(
            branch.body,
            angle,
            spin,
            spin_partials,
            origin,
            velocity,
            bias,
            spin_bias,
            partials,
            hub,
        )

    def _float(self, branch: Branch) -> Carried:
        x, y, *free = branch.coordinates
        turning = branch.turned_by or free[0]
        prescribed = branch.turned_by is not None
        angle, spin, spin_bias = (
            self.moved[turning]
            if prescribed
            else (self.position[turning], self.speed[turning], 0.0)
        )
        self._orient(branch.body, angle)
        along = FrameVector(self.orientations, {WORLD: (1.0, 0.0)})
        across = FrameVector(self.orientations, {WORLD: (0.0, 1.0)})
        return Carried(
            branch.body,
            angle,
            spin,
            {turning: 1.0},
            along.scaled(self.position[x]) + across.scaled(self.position[y]),
            along.scaled(self.speed[x]) + across.scaled(self.speed[y]),
            FrameVector(self.orientations),
            spin_bias,
            {x: along, y: across},
            (0.0, 0.0),
        )

    def _orient(self, body: str, angle: Scalar) -> None:
        sine, cosine = sine_cosine(angle)
        self.orientations.cosine_sine[body] = (cosine, sine)
