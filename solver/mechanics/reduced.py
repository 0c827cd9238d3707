"""Equations of motion in joint coordinates over the spanning tree (Kane's form).

Only what the scene requires: a driven crank on the ground is a known function of time, an ideal
joint removes coordinates, a joint with play is a force. With partial velocities J,
Σ_b (m J·J + I Jω Jω) q̈ = Σ_b J·(m (g - bias) + F) + Jω T. Joints that close a loop of ideal
joints hold by forces, see `solver.mechanics.loops`.
"""

from collections.abc import Mapping, Sequence

from jointplay.solver.laws.force import Ends
from jointplay.solver.mechanics.elimination import Matrix, is_zero, solve_symmetric
from jointplay.solver.mechanics.kinematics import Kinematics
from jointplay.solver.mechanics.loads import NO_LOAD, Loads, about_references
from jointplay.solver.mechanics.loops import Exerted, Loops
from jointplay.solver.mechanics.motion import NOTHING, BodyMotion, Motion, forces_between
from jointplay.solver.mechanics.tree import Branch, Tree
from jointplay.solver.quantities.frames import WORLD, FrameVector, Pair, cross
from jointplay.solver.quantities.scalars import Scalar
from jointplay.solver.scene.document import Scene


class ReducedMechanism:
    """A scene at one instant: kinematics, contacts, accelerations, reactions."""

    def __init__(
        self,
        tree: Tree,
        numbers: Scene,
        position: Mapping[str, Scalar],
        speed: Mapping[str, Scalar],
        driven: Mapping[str, Scalar],
        wound: Mapping[str, Scalar] = NOTHING,
    ) -> None:
        """`driven`: all clocks; `wound`: whole turns of bodies that drivers turn, rad."""
        self.tree = tree
        self.numbers = numbers
        self.kinematics = Kinematics(tree, numbers, position, speed, driven, wound)

    def motion(
        self,
        modes: Mapping[str, Scalar],
        impact_rates: Mapping[str, Scalar],
        inner: Mapping[str, Sequence[Scalar]] = NOTHING,
        known: list[Scalar] | None = None,
    ) -> Motion:
        """Return accelerations and all forces; modes and impact rates (m/s) by contact pair.

        `inner` states of friction laws by pair, where there are any; `known` accelerations of the
        coordinates, where they were computed before.
        """
        forces = forces_between(
            self.numbers,
            self._ends,
            self.kinematics.driven,
            self.tree.play,
            modes,
            impact_rates,
            inner,
        )
        loads = about_references(self.kinematics, forces.interactions)
        cut = Exerted()
        multipliers: list[Scalar] = []
        if self.tree.closing:
            loops = self.loops()
            accelerations, multipliers = loops.accelerations(self._generalised(loads))
            cut = loops.exerted(multipliers)
            acting = [*forces.interactions, *cut.interactions.values(), *cut.couples]
            loads = about_references(self.kinematics, acting)
        elif known is None:
            accelerations = self._accelerations(loads)
        if known is not None:
            accelerations = known
        bodies = self._bodies(accelerations)
        joint_force, moments = self._reactions(loads, bodies)
        joint_force |= forces.of_joints()
        for name, holding in cut.interactions.items():
            joint_force[name] = holding.force_on_second
        held = (
            self._held_moments(joint_force, moments)
            | cut.moments
            | forces.held(self.numbers.joints)
        )
        efforts = self._efforts(joint_force, moments, cut.efforts)
        speeds = {name: self.kinematics.speed[name] for name in self.numbers.drivers}
        return Motion(
            accelerations, bodies, forces, joint_force, held, efforts, speeds, multipliers
        )

    def loops(self) -> Loops:
        """Return the equations of joints that close loops."""
        return Loops(self.kinematics, self._mass_matrix())

    def _ends(self, first: str, second: str) -> Ends:
        k = self.kinematics
        (here, p), (there, q) = first.split("."), second.split(".")
        start, start_rate, _ = k.point_motion(here, k.arm(here, p))
        end, end_rate, _ = k.point_motion(there, k.arm(there, q))
        return Ends(
            (end + start.scaled(-1.0)).world(),
            (end_rate + start_rate.scaled(-1.0)).world(),
            (k.carried[here].spin, k.carried[there].spin),
            (k.orientations.cosine_sine[here], k.orientations.cosine_sine[there]),
            (k.whole_angle(here), k.whole_angle(there)),
        )

    def _accelerations(self, loads: Loads) -> list[Scalar]:
        """Solve M q̈ = Q."""
        mass_matrix = self._mass_matrix()
        [found] = solve_symmetric(mass_matrix, [self._generalised(loads)])
        return found

    def _mass_matrix(self) -> Matrix:
        """Return M, from partial velocities."""
        k = self.kinematics
        names = self.tree.coordinates
        index = {name: i for i, name in enumerate(names)}
        mass_matrix: dict[tuple[int, int], Scalar] = {}
        for branch in self.tree.branches:
            body = self.numbers.bodies[branch.body]
            frame = k.carried[branch.body]
            _, _, partials = k.point_motion(branch.body, k.centre(branch.body))
            moving = [name for name in names if name in partials or name in frame.spin_partials]
            for a, first in enumerate(moving):
                for second in moving[: a + 1]:
                    entry: Scalar = 0.0
                    if first in partials and second in partials:
                        entry = body.mass * partials[first].dot(partials[second])
                    if first in frame.spin_partials and second in frame.spin_partials:
                        share = frame.spin_partials[first] * frame.spin_partials[second]
                        entry = entry + body.inertia * share
                    key = (index[first], index[second])
                    mass_matrix[key] = mass_matrix.get(key, 0.0) + entry
        return mass_matrix

    def _generalised(self, loads: Loads) -> list[Scalar]:
        """Return Q, by one pass from the leaves inwards."""
        k = self.kinematics
        gx, gy = self.numbers.gravity
        inertial = {}
        for branch in self.tree.branches:
            body, spin_bias = self.numbers.bodies[branch.body], k.carried[branch.body].spin_bias
            bx, by = k.point_bias(branch.body, k.centre(branch.body)).world()
            turning = 0.0 if is_zero(spin_bias) else -(body.inertia * spin_bias)
            inertial[branch.body] = (body.mass * (gx - bx), body.mass * (gy - by), turning)
        generalised = self._project(loads, inertial)
        return [generalised.get(name, 0.0) for name in self.tree.coordinates]

    def _project(self, loads: Loads, extra: Loads) -> dict[str, Scalar]:
        """Return generalised forces of all loads: subtree sums from the leaves to the ground."""
        sums, moments = self._subtree(loads, extra)
        generalised: dict[str, Scalar] = {}
        k = self.kinematics
        for branch in self.tree.branches:
            total, moment = sums[branch.body], moments[branch.body]
            if branch.freedom == "turn" and branch.coordinates:
                generalised[branch.coordinates[0]] = moment
            elif branch.freedom == "slide" and branch.coordinates:
                name = branch.coordinates[0]
                ux, uy = k.carried[branch.body].partials[name].world()
                generalised[name] = ux * total[0] + uy * total[1]
            elif branch.freedom == "all":
                generalised |= zip(branch.coordinates, (*total, moment), strict=False)
        return generalised

    def _subtree(self, loads: Loads, extra: Loads) -> tuple[dict[str, Pair], dict[str, Scalar]]:
        """Sum forces outboard of each tree joint, and the moments that it does not let turn.

        The moment is about the body's reference point. Across a free revolute joint the outboard
        bodies do not turn along, so only their force is handed on.
        """
        k = self.kinematics
        sums: dict[str, Pair] = {}
        moments: dict[str, Scalar] = {}
        for branch in self.tree.branches:
            fx, fy, moment = loads.get(branch.body, NO_LOAD)
            ex, ey, turning = extra[branch.body]
            centre = k.centre(branch.body).world()
            sums[branch.body] = (fx + ex, fy + ey)
            moments[branch.body] = moment + turning + cross(centre, (ex, ey))
        for branch in reversed(self.tree.branches):
            if branch.parent == WORLD:
                continue
            total = sums[branch.body]
            own = sums[branch.parent]
            sums[branch.parent] = (own[0] + total[0], own[1] + total[1])
            arm = k.arm(branch.parent, branch.parent_point)
            handed = cross(arm.world(), total)
            if branch.freedom != "turn" or branch.driver is not None:
                handed = handed + moments[branch.body]
                if branch.freedom == "slide":
                    handed = handed + cross(self._travel(branch, arm), total)
            moments[branch.parent] = moments[branch.parent] + handed
        return sums, moments

    def _travel(self, branch: Branch, arm: FrameVector) -> Pair:
        """Return the vector from a prismatic joint's point on the parent to that on the body."""
        parent = self.kinematics.carried[branch.parent].origin + arm
        return (self.kinematics.carried[branch.body].origin + parent.scaled(-1.0)).world()

    def _bodies(self, accelerations: list[Scalar]) -> dict[str, BodyMotion]:
        k = self.kinematics
        rates = dict(zip(self.tree.coordinates, accelerations, strict=True))
        bodies = {}
        for branch in self.tree.branches:
            frame, centre = k.carried[branch.body], k.centre(branch.body)
            position, velocity, partials = k.point_motion(branch.body, centre)
            ax, ay = k.point_bias(branch.body, centre).world()
            for name, partial in partials.items():
                if name in rates:
                    px, py = partial.world()
                    ax, ay = ax + rates[name] * px, ay + rates[name] * py
            alpha = frame.spin_bias
            for name, share in frame.spin_partials.items():
                if name in rates:
                    alpha = alpha + share * rates[name]
            bodies[branch.body] = BodyMotion(
                position.world(), frame.angle, velocity.world(), frame.spin, (ax, ay), alpha
            )
        return bodies

    def _reactions(
        self, loads: Loads, bodies: Mapping[str, BodyMotion]
    ) -> tuple[dict[str, Pair], dict[str, Scalar]]:
        """Return force on the second body and moment on the outboard body of each tree joint.

        Moments of drivers that turn bodies against the ground stand beside those of joints.
        """
        gx, gy = self.numbers.gravity
        inertial = {}
        for name, body in bodies.items():
            mass, inertia = self.numbers.bodies[name].mass, self.numbers.bodies[name].inertia
            (ax, ay), alpha = body.acceleration, body.angular_acceleration
            inertial[name] = (mass * (gx - ax), mass * (gy - ay), -(inertia * alpha))
        sums, moments = self._subtree(loads, inertial)
        forces: dict[str, Pair] = {}
        held: dict[str, Scalar] = {}
        for branch in self.tree.branches:
            if branch.turned_by is not None:
                held[branch.turned_by] = -moments[branch.body]
            if branch.freedom == "all":
                continue
            x, y = sums[branch.body]
            # the joint supplies what the outboard bodies lack; by convention on the second body
            forces[branch.joint] = (-x, -y) if branch.outward else (x, y)
            held[branch.joint] = -moments[branch.body]
        return forces, held

    def _held_moments(
        self, forces: Mapping[str, Pair], moments: Mapping[str, Scalar]
    ) -> dict[str, Scalar]:
        """Return the moment on the second body of joints that hold an angle, about its point."""
        held: dict[str, Scalar] = {}
        for branch in self.tree.branches:
            if branch.freedom not in ("slide", "none"):
                continue
            moment = moments[branch.joint]
            if not branch.outward:
                moment = -moment
                if branch.freedom == "slide":  # the guide's point is elsewhere
                    arm = self.kinematics.arm(branch.parent, branch.parent_point)
                    moment = moment + cross(self._travel(branch, arm), forces[branch.joint])
            held[branch.joint] = moment
        return held

    def _efforts(
        self,
        forces: Mapping[str, Pair],
        moments: Mapping[str, Scalar],
        cut: Mapping[str, Scalar],
    ) -> dict[str, Scalar]:
        """Return efforts of drivers; those of cut joints are known."""
        efforts: dict[str, Scalar] = {}
        for name in self.numbers.drivers:
            if name in cut or name in moments:  # the latter turns a body whatever its joint
                efforts[name] = cut[name] if name in cut else moments[name]
                continue
            branch = next(b for b in self.tree.branches if b.driver == name)
            if branch.freedom == "turn":
                efforts[name] = moments[branch.joint] if branch.outward else -moments[branch.joint]
            else:
                ux, uy = self.kinematics.carried[branch.body].partials[name].world()
                fx, fy = forces[branch.joint]
                along = ux * fx + uy * fy
                efforts[name] = along if branch.outward else -along
        return efforts
