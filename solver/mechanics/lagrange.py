"""Equations of motion in absolute coordinates with Lagrange multipliers: the paper's eqs 18-26.

An independent formulation of the same mechanics, for cross-checks: 3 coordinates a body, the
constraints of ideal joints and drivers, Baumgarte's stabilisation (eq. 26).
"""

from collections.abc import Mapping, Sequence

from jointplay.solver.laws.force import Ends
from jointplay.solver.mechanics.absolute import AbsoluteMechanism
from jointplay.solver.mechanics.elimination import solve_semidefinite, solve_symmetric
from jointplay.solver.mechanics.motion import NOTHING, Forces, Motion, body_motions, forces_between
from jointplay.solver.mechanics.rows import Row
from jointplay.solver.mechanics.tree import spanning_tree
from jointplay.solver.quantities.scalars import Scalar
from jointplay.solver.scene.document import Scene

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

    def motion(
        self,
        modes: Mapping[str, Scalar],
        impact_rates: Mapping[str, Scalar],
        inner: Mapping[str, Sequence[Scalar]] = NOTHING,
    ) -> Motion:
        """Return accelerations and all forces; see `ReducedMechanism.motion`."""
        play = [name for name, joint in self.scene.joints.items() if joint.has_play]
        forces = forces_between(
            self.numbers, self._ends, self.driven, play, modes, impact_rates, inner
        )
        applied = self._applied(forces)
        rows = self.constraints.rows(self.q, self.v, self.driven)
        accelerations, multipliers = self._solve(rows, applied)
        bodies = body_motions(self.constraints.bodies, self.q, self.v, accelerations)
        joint_force, held, efforts = self.constraints.reactions(rows, multipliers)
        joint_force |= forces.of_joints()
        held |= forces.held(self.numbers.joints)
        drivers = self.numbers.drivers.items()
        speeds = {name: driver.at(self.driven[name]).slope for name, driver in drivers}
        return Motion(accelerations, bodies, forces, joint_force, held, efforts, speeds)

    def _ends(self, first: str, second: str) -> Ends:
        return self.constraints.ends((first, second), self.q, self.v)

    def _applied(self, between: Forces) -> list[Scalar]:
        """Generalised forces g of eq. (23): gravity, contacts and force elements."""
        gx, gy = self.numbers.gravity
        forces: list[Scalar] = []
        for name in self.constraints.bodies:
            mass = self.numbers.bodies[name].mass
            forces += [mass * gx, mass * gy, 0.0]
        self.constraints.apply(between, forces, self.q, self.v)
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
        if spanning_tree(self.scene).closing:  # joints of a loop may hold the same twice
            kinds = ["angle" if row.part == "angle" else "length" for row in rows]
            multipliers = solve_semidefinite(system, right, kinds)
        else:
            [multipliers] = solve_symmetric(system, [right])
        accelerations = list(free)
        for row, multiplier in zip(rows, multipliers, strict=True):
            for k, entry in row.jacobian.items():
                accelerations[k] = accelerations[k] - inverse_mass[k] * entry * multiplier
        return accelerations, multipliers
