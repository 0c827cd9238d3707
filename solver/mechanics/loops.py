"""Closed loops of ideal joints: the equations of joints that the spanning tree leaves out.

Such a joint is cut. What it holds together are rows Φ(q, t) = 0 in the coordinates of the tree,
with the Jacobian J from the same partial velocities as the mass matrix M. Accelerations then are
q̈ = M⁻¹ (Q + Jᵀ μ), where J q̈ + bias = 0 gives (J M⁻¹ Jᵀ) μ = -bias - J M⁻¹ Q. The same matrix
brings coordinates and speeds that have drifted back, by the least change that the masses allow.

Source: Featherstone 2008, Rigid Body Dynamics Algorithms, section 8.5 (loop-closure equations) and
Eich 1993, SIAM Journal on Numerical Analysis 30:1467 (projection).
"""

from collections.abc import Sequence
from dataclasses import dataclass, field

from jointplay.solver.joints.contact import Interaction
from jointplay.solver.mechanics.closing_rows import Between, closing_rows
from jointplay.solver.mechanics.elimination import (
    Matrix,
    is_zero,
    solve_semidefinite,
    solve_symmetric,
)
from jointplay.solver.mechanics.kinematics import Kinematics
from jointplay.solver.mechanics.reaction import Reaction
from jointplay.solver.quantities.scalars import Scalar


@dataclass(frozen=True)
class Exerted:
    """Action of cut joints and of gears: by name, moments (N m) of what holds an angle, by driver.

    Moments are those on the second body, about its point; efforts are N m or N.
    """

    interactions: dict[str, Interaction] = field(default_factory=dict)
    moments: dict[str, Scalar] = field(default_factory=dict)
    efforts: dict[str, Scalar] = field(default_factory=dict)
    couples: list[Interaction] = field(default_factory=list)
    """Moments that gears put on the bodies of their joints."""


class Loops:
    """The rows of a scene's cut joints and what they weigh: J and J M⁻¹ Jᵀ at one instant."""

    def __init__(self, kinematics: Kinematics, mass_matrix: Matrix) -> None:
        self.kinematics = kinematics
        self.names = kinematics.tree.coordinates
        self.mass_matrix = mass_matrix
        self.rows = closing_rows(kinematics)
        jacobian = [[row.partials.get(n, 0.0) for n in self.names] for row in self.rows]
        self.entries = [
            [(k, entry) for k, entry in enumerate(row) if not is_zero(entry)] for row in jacobian
        ]
        """J, of each row its columns and entries that are not 0."""
        self.responses = solve_symmetric(mass_matrix, jacobian)
        """M⁻¹ Jᵀ, a list a row: the accelerations that its unit multiplier gives."""
        self.matrix = {
            (i, j): self._along(i, self.responses[j])
            for i in range(len(self.rows))
            for j in range(i + 1)
        }

    def accelerations(self, generalised: list[Scalar]) -> tuple[list[Scalar], list[Scalar]]:
        """Return q̈ and the multipliers μ, N or N m, under generalised forces."""
        [free] = solve_symmetric(self.mass_matrix, [generalised])
        wanted = [-row.bias - self._along(i, free) for i, row in enumerate(self.rows)]
        multipliers = self._multipliers(wanted)
        return self._moved(free, multipliers), multipliers

    def correction(self, residuals: Sequence[Scalar]) -> list[Scalar]:
        """Return the least change of coordinates, or of speeds, that takes residuals away.

        Least in the metric of the mass matrix; residuals : (rows,) J times what is to go.
        """
        still: list[Scalar] = [0.0] * len(self.names)
        return self._moved(still, self._multipliers([-r for r in residuals]))

    def along(self, vector: Sequence[Scalar]) -> list[Scalar]:
        """Return J times a vector of coordinates, (rows,)."""
        return [self._along(i, vector) for i in range(len(self.rows))]

    def exerted(self, multipliers: Sequence[Scalar]) -> Exerted:
        """Return what cut joints exert."""
        k = self.kinematics
        by_part: dict[str, dict[str, Scalar]] = {}
        for row, multiplier in zip(self.rows, multipliers, strict=True):
            by_part.setdefault(row.joint, {})[row.part] = multiplier
        drivers = {driver.joint: name for name, driver in k.numbers.drivers.items()}
        found = Exerted()
        for name, parts in by_part.items():
            if name in k.numbers.gears:
                moment = found.moments[name] = parts["angle"]
                for factor, second, first in k.numbers.gears[name].sides(k.numbers.joints):
                    turn = factor * moment
                    found.couples.append(Interaction(first, second, (0.0, 0.0), -turn, turn))
                continue
            joint, motion = k.numbers.joints[name], None
            if name in drivers:
                motion = k.moved[drivers[name]]
            reaction = Reaction(Between(k, name), parts)
            for _ in joint.rows(reaction, motion):
                pass
            found.interactions[name] = reaction.interaction(*joint.points)
            if joint.holds_angle:
                found.moments[name] = parts["angle"]
            if name in drivers:
                found.efforts[drivers[name]] = parts[joint.driven_part or ""]
        return found

    def _multipliers(self, right: list[Scalar]) -> list[Scalar]:
        kinds = ["angle" if row.part == "angle" else "length" for row in self.rows]
        return solve_semidefinite(self.matrix, right, kinds)

    def _along(self, i: int, vector: Sequence[Scalar]) -> Scalar:
        """Return the product of row i of J and a vector."""
        total: Scalar = 0.0
        for k, entry in self.entries[i]:
            if not is_zero(vector[k]):
                total = total + entry * vector[k]
        return total

    def _moved(self, vector: Sequence[Scalar], multipliers: Sequence[Scalar]) -> list[Scalar]:
        moved = list(vector)
        for response, multiplier in zip(self.responses, multipliers, strict=True):
            for i, value in enumerate(response):
                if not is_zero(value):
                    moved[i] = moved[i] + value * multiplier
        return moved
