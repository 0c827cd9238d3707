"""Equations of motion in absolute coordinates with Lagrange multipliers: the paper's eqs 18-26.

An independent formulation of the same mechanics, for cross-checks: 3 coordinates a body, the
constraints of ideal joints and drivers, Baumgarte's stabilisation (eq. 26).
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from jointplay.solver.mechanics.absolute import AbsoluteMechanism, Row
from jointplay.solver.mechanics.elimination import solve_symmetric
from jointplay.solver.mechanics.motion import BodyMotion, Motion
from jointplay.solver.mechanics.play import Contact, Interaction, contact
from jointplay.solver.mechanics.reactions import joint_reactions
from jointplay.solver.quantities.scalars import Scalar
from jointplay.solver.scene.document import Revolute, Scene
from jointplay.solver.scene.references import has_play

BAUMGARTE_ALPHA = 50.0
BAUMGARTE_BETA = 50.0
"""Baumgarte's constants, 1/s; the paper prints none. They act over 20 ms: fast against a
revolution, slow against an impact, so that they neither stiffen nor drift."""


class LagrangeMechanism:
    """A scene at one instant in absolute coordinates."""

    def __init__(
        self,
        scene: Scene,
        numbers: Scene,
        q: Sequence[Scalar],
        v: Sequence[Scalar],
        driven: Mapping[str, Scalar],
    ) -> None:
        """q, v : (3 bodies,) x, y (m), theta (rad) of each body and rates, in document order."""
        self.scene = scene
        self.numbers = numbers
        self.constraints = AbsoluteMechanism(scene, numbers, close_play=False)
        self.q, self.v = q, v
        self.driven = driven

    def motion(self, modes: Mapping[str, Scalar], impact_rates: Mapping[str, Scalar]) -> Motion:
        """Return accelerations and all forces; modes and impact rates (m/s) by joint with play."""
        play = [name for name, joint in self.scene.joints.items() if has_play(joint)]
        contacts = {name: self._contact(name, modes[name], impact_rates[name]) for name in play}
        applied = self._applied(found.interaction for found in contacts.values())
        rows = self.constraints.rows(self.q, self.v, self.driven)
        accelerations, multipliers = self._solve(rows, applied)
        bodies = {
            name: BodyMotion(
                (self.q[3 * i], self.q[3 * i + 1]),
                self.q[3 * i + 2],
                (self.v[3 * i], self.v[3 * i + 1]),
                self.v[3 * i + 2],
                (accelerations[3 * i], accelerations[3 * i + 1]),
                accelerations[3 * i + 2],
            )
            for i, name in enumerate(self.constraints.bodies)
        }
        joint_force, efforts = joint_reactions(self.scene, self.constraints, rows, multipliers)
        for name, found in contacts.items():
            joint_force[name] = found.interaction.force_on_second
        speeds = {name: driver.speed for name, driver in self.numbers.drivers.items()}
        return Motion(accelerations, bodies, contacts, joint_force, efforts, speeds)

    def _contact(self, name: str, mode: Scalar, impact_rate: Scalar) -> Contact:
        joint = self.numbers.joints[name]
        assert isinstance(joint, Revolute)  # noqa: S101  (narrows the type)
        bearing = self.constraints.marker(joint.bearing, self.q, self.v)
        journal = self.constraints.marker(joint.journal, self.q, self.v)
        gap = (
            journal.position[0] - bearing.position[0],
            journal.position[1] - bearing.position[1],
        )
        rate = (
            journal.velocity[0] - bearing.velocity[0],
            journal.velocity[1] - bearing.velocity[1],
        )
        spins = tuple(
            0.0 if marker.body < 0 else self.v[3 * marker.body + 2] for marker in (bearing, journal)
        )
        return contact(joint, gap, rate, (spins[0], spins[1]), mode, impact_rate)

    def _applied(self, interactions: Iterable[Interaction]) -> list[Scalar]:
        """Generalised forces g of eq. (23): gravity and contacts."""
        gx, gy = self.numbers.gravity
        forces: list[Scalar] = []
        for name in self.constraints.bodies:
            mass = self.numbers.bodies[name].mass
            forces += [mass * gx, mass * gy, 0.0]
        for acting in interactions:
            fx, fy = acting.force_on_second
            for reference, sign, moment in (
                (acting.second, 1.0, acting.moment_on_second),
                (acting.first, -1.0, acting.moment_on_first),
            ):
                marker = self.constraints.marker(reference, self.q, self.v)
                if marker.body < 0:
                    continue
                k, (ax, ay) = 3 * marker.body, marker.arm
                forces[k] = forces[k] + sign * fx
                forces[k + 1] = forces[k + 1] + sign * fy
                forces[k + 2] = forces[k + 2] + moment + sign * (ax * fy - ay * fx)
        return forces

    def _solve(self, rows: list[Row], applied: list[Scalar]) -> tuple[list[Scalar], list[Scalar]]:
        """Eqs (25)-(26) by elimination of q̈: (Φ_q M⁻¹ Φ_qᵀ) λ = Φ_q M⁻¹ g - γ'."""
        inverse_mass: list[Scalar] = []
        for name in self.constraints.bodies:
            body = self.numbers.bodies[name]
            inverse_mass += [1.0 / body.mass, 1.0 / body.mass, 1.0 / body.inertia]
        free = [weight * force for weight, force in zip(inverse_mass, applied, strict=True)]
        system: dict[tuple[int, int], Scalar] = {}
        right: list[Scalar] = []
        for i, row in enumerate(rows):
            stabilised = (
                row.gamma
                - (2.0 * BAUMGARTE_ALPHA) * row.rate
                - (BAUMGARTE_BETA * BAUMGARTE_BETA) * row.value
            )
            unconstrained: Scalar = 0.0
            for k, entry in row.jacobian.items():
                unconstrained = unconstrained + entry * free[k]
            right.append(unconstrained - stabilised)
            for j, other in enumerate(rows[: i + 1]):
                shared = [k for k in row.jacobian if k in other.jacobian]
                if shared:
                    total: Scalar = 0.0
                    for k in shared:
                        total = total + row.jacobian[k] * inverse_mass[k] * other.jacobian[k]
                    system[i, j] = total
        multipliers = solve_symmetric(system, right)
        accelerations = list(free)
        for row, multiplier in zip(rows, multipliers, strict=True):
            for k, entry in row.jacobian.items():
                accelerations[k] = accelerations[k] - inverse_mass[k] * entry * multiplier
        return accelerations, multipliers
