"""Constraint equations in absolute coordinates: the paper's eqs 18-22 for any scene.

Every body has x, y (centre of mass, m) and theta (rad) in the world frame; joints and drivers
give equations Φ(q, t) = 0. Runs on floats, arrays of instants and traced expressions.
"""

from collections.abc import Collection, Mapping

from jointplay.solver.laws.force import Ends
from jointplay.solver.laws.function import Derivatives
from jointplay.solver.mechanics.absolute_holding import (
    CENTRED,
    CONCENTRIC,
    AbsoluteHolding,
    ends_of,
)
from jointplay.solver.mechanics.motion import Forces
from jointplay.solver.mechanics.rows import RESTING, Marker, Row, angle_row
from jointplay.solver.quantities.frames import WORLD, Pair
from jointplay.solver.quantities.scalars import Scalar, Scalars, sine_cosine
from jointplay.solver.scene.document import Scene


class AbsoluteMechanism:
    """A scene's constraint rows as functions of q, q̇ and t."""

    def __init__(
        self,
        scene: Scene,
        numbers: Scene,
        *,
        close_play: bool,
        held: Collection[str] = (),
        driven: bool = True,
    ) -> None:
        """`close_play` holds every journal where it starts (start and ideal mechanism).

        Otherwise only those `held` are, by the name of their joint. Unless it is `driven`, drivers
        let go.
        """
        self.scene = scene
        self.numbers = numbers
        self.bodies = tuple(scene.bodies)
        drivers = scene.drivers if driven else {}
        self.drivers = {d.joint: name for name, d in drivers.items() if d.joint}
        self.turned = {d.body: name for name, d in drivers.items() if d.body}
        for body in list(self.turned):
            pin = _pin_on_ground(scene, body)
            if pin is not None and pin not in self.drivers:
                self.drivers[pin] = self.turned.pop(body)
        self.joints = tuple(
            name
            for name, joint in scene.joints.items()
            if close_play or name in held or not joint.has_play
        )

    def marker(self, reference: str, q: Scalars, v: Scalars) -> Marker:
        """Return a point's arm, position and velocity; q, v : (3 bodies,) m, m, rad and rates."""
        body, point = reference.split(".")
        if body == "ground":
            x, y = self.numbers.ground.points[point]
            return Marker(-1, (0.0, 0.0), (x, y), (0.0, 0.0), 0.0, 0.0)
        i = self.bodies.index(body)
        x, y = self.numbers.bodies[body].points[point]
        sine, cosine = sine_cosine(q[3 * i + 2])
        arm = (cosine * x - sine * y, sine * x + cosine * y)
        spin = v[3 * i + 2]
        return Marker(
            i,
            arm,
            (q[3 * i] + arm[0], q[3 * i + 1] + arm[1]),
            (v[3 * i] - spin * arm[1], v[3 * i + 1] + spin * arm[0]),
            q[3 * i + 2],
            spin,
            (cosine, sine),
        )

    def ends(self, points: tuple[str, str], q: Scalars, v: Scalars, wound: Scalars = ()) -> Ends:
        """Return how the second of two named points lies and moves against the first.

        wound : (3 bodies,) whole turns of angles that `q` leaves out, rad.
        """
        here, there = self.marker(points[0], q, v), self.marker(points[1], q, v)
        one, two = (
            marker.angle + (wound[3 * marker.body + 2] if wound and marker.body >= 0 else 0.0)
            for marker in (here, there)
        )
        return ends_of(here, there, (one, two))

    def apply(self, between: Forces, forces: list[Scalar], q: Scalars, v: Scalars) -> None:
        """Add forces between bodies to generalised forces, (3 bodies,) N, N, N m."""
        for acting in between.interactions:
            fx, fy = acting.force_on_second
            for reference, sign, moment in (
                (acting.second, 1.0, acting.moment_on_second),
                (acting.first, -1.0, acting.moment_on_first),
            ):
                marker = self.marker(reference, q, v)
                if marker.body < 0:
                    continue
                k, (ax, ay) = 3 * marker.body, marker.arm
                forces[k] = forces[k] + sign * fx
                forces[k + 1] = forces[k + 1] + sign * fy
                forces[k + 2] = forces[k + 2] + moment + sign * (ax * fy - ay * fx)

    def rows(self, q: Scalars, v: Scalars, driven: Mapping[str, Scalar]) -> list[Row]:
        """Return every constraint row.

        q, v : (3 bodies,), m, m, rad and their rates. `driven` gives each driver's clock at
        this instant.
        """
        rows: list[Row] = []
        for name in self.joints:
            held = self._held(name, q, v)
            rows += self.numbers.joints[name].rows(held, self._driver(name, driven))
        still = Marker(-1, (0.0, 0.0), (0.0, 0.0), (0.0, 0.0), 0.0, 0.0)
        for body, name in self.turned.items():
            i = self.bodies.index(body)
            turning = still._replace(body=i, angle=q[3 * i + 2], spin=v[3 * i + 2])
            motion = self.numbers.drivers[name].at(driven[name])
            rows.append(angle_row(name, still, turning, motion))
        return rows + [self._gear(name, q, v) for name in self.numbers.gears]

    def slides(self, q: Scalars, v: Scalars) -> list[Row]:
        """Return a row for each joint with an axis: its second point is where its first is on that.

        Nothing demands them: they say where a slide, or a pin in a slot, is in the middle.
        """
        headings = {name: self.numbers.joints[name].heading for name in self.joints}
        return [
            self._held(name, q, v).along(heading, RESTING)
            for name, heading in headings.items()
            if heading is not None
        ]

    def _held(self, name: str, q: Scalars, v: Scalars) -> AbsoluteHolding:
        """Return a joint between its markers, as it starts."""
        first, second = (self.marker(point, q, v) for point in self.numbers.joints[name].points)
        start = self.scene.start
        journal, guided = start.joints.get(name, CONCENTRIC), start.guides.get(name, CENTRED)
        return AbsoluteHolding(name, (first, second), journal, guided)

    def _gear(self, name: str, q: Scalars, v: Scalars) -> Row:
        """α_2 - ratio α_1 - offset = 0."""
        gear = self.numbers.gears[name]
        jacobian: dict[int, Scalar] = {}
        value, rate = -gear.offset, 0.0
        for factor, body in gear.coupled(self.numbers.joints):
            if body != WORLD:
                k = 3 * self.bodies.index(body) + 2
                jacobian[k] = jacobian.get(k, 0.0) + factor
                value, rate = value + factor * q[k], rate + factor * v[k]
        return Row(name, "angle", value, jacobian, rate, 0.0)

    def _driver(self, name: str, driven: Mapping[str, Scalar]) -> Derivatives | None:
        """Return the prescribed motion of a joint, if it is driven."""
        driver = self.drivers.get(name)
        return None if driver is None else self.numbers.drivers[driver].at(driven[driver])

    def reactions(
        self, rows: list[Row], multipliers: list[Scalar]
    ) -> tuple[dict[str, Pair], dict[str, Scalar], dict[str, Scalar]]:
        """Return -Φ_qᵀ λ: force and held moment on each joint's second body, and drivers' efforts.

        Forces in N and moments in N m by joint, efforts in N m or N by driver; the moment is that
        of joints which hold an angle, about the second body's point. multipliers : λ of each row.
        """
        forces: dict[str, Pair] = {}
        moments: dict[str, Scalar] = {}
        efforts: dict[str, Scalar] = {}
        for row, multiplier in zip(rows, multipliers, strict=True):
            if row.joint in self.scene.drivers:
                efforts[row.joint] = -multiplier
                continue
            if row.joint in self.scene.gears:
                moments[row.joint] = -multiplier
                continue
            joint = self.scene.joints[row.joint]
            (first, body), sign = joint.bodies, 1.0
            if body == WORLD:
                body, sign = first, -1.0
            k = 3 * self.bodies.index(body)
            x, y = forces.get(row.joint, (0.0, 0.0))
            fx = row.jacobian.get(k, 0.0) * multiplier
            fy = row.jacobian.get(k + 1, 0.0) * multiplier
            forces[row.joint] = (x - sign * fx, y - sign * fy)
            driver = self.drivers.get(row.joint)
            if driver is not None and row.part == joint.driven_part:
                efforts[driver] = -multiplier
            if row.part == "angle" and joint.holds_angle:
                moments[row.joint] = -multiplier
        return forces, moments, efforts


def _pin_on_ground(scene: Scene, body: str) -> str | None:
    """Return the first ideal pin whose bearing is on the ground and whose journal on a body."""
    for name, joint in scene.joints.items():
        if joint.freedom == "turn" and not joint.has_play and joint.bodies == (WORLD, body):
            return name
    return None
