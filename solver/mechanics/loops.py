"""Closed loops of ideal joints: the equations of joints that the spanning tree leaves out.

Such a joint is cut. What it holds together are rows Φ(q, t) = 0 in the coordinates of the tree,
with the Jacobian J from the same partial velocities as the mass matrix M. Accelerations then are
q̈ = M⁻¹ (Q + Jᵀ μ), where J q̈ + bias = 0 gives (J M⁻¹ Jᵀ) μ = -bias - J M⁻¹ Q. The same matrix
brings coordinates and speeds that have drifted back, by the least change that the masses allow.

Source: Featherstone 2008, Rigid Body Dynamics Algorithms, section 8.5 (loop-closure equations) and
Eich 1993, SIAM Journal on Numerical Analysis 30:1467 (projection; not yet checked).
"""

from collections.abc import Sequence
from dataclasses import dataclass, field

from jointplay.solver.laws.function import Derivatives
from jointplay.solver.mechanics.absolute import RESTING
from jointplay.solver.mechanics.elimination import (
    Matrix,
    is_zero,
    solve_semidefinite,
    solve_symmetric,
)
from jointplay.solver.mechanics.frames import FrameVector, Pair, cross, unit
from jointplay.solver.mechanics.gears import coupled, sides
from jointplay.solver.mechanics.kinematics import Kinematics
from jointplay.solver.mechanics.play import Interaction
from jointplay.solver.quantities.scalars import Scalar, sine_cosine
from jointplay.solver.scene.channels import HOLDING
from jointplay.solver.scene.joints import Fixed, PinInSlot, Prismatic, Revolute
from jointplay.solver.scene.references import ends


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


class _Between:
    """A cut joint's second point against its first."""

    def __init__(self, kinematics: Kinematics, joint: str) -> None:
        k = self.kinematics = kinematics
        (_, here), (_, there) = ends(k.numbers.joints[joint])
        self.joint = joint
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

    def coincidence(self) -> list[ClosingRow]:
        """Return the rows of two points that are one, x and y in the world's axes."""
        (x, y), (vx, vy), (ax, ay) = self.gap.world(), self.rate.world(), self.bias.world()
        partials = {name: partial.world() for name, partial in self.partials.items()}
        return [
            self._row("x", x, vx, {name: px for name, (px, _) in partials.items()}, ax),
            self._row("y", y, vy, {name: py for name, (_, py) in partials.items()}, ay),
        ]

    def projection(
        self, part: str, direction: FrameVector, motion: Derivatives = RESTING
    ) -> ClosingRow:
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

    def angle(self, motion: Derivatives) -> ClosingRow:
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
        joint, between = numbers.joints[name], _Between(kinematics, name)
        motion = kinematics.moved[drivers[name]] if name in drivers else None
        held = Derivatives(getattr(joint, "angle", 0.0), 0.0, 0.0)
        if isinstance(joint, Prismatic):
            axis = _axis(kinematics, between.first, joint)
            rows += [between.projection("normal", axis.turned()), between.angle(held)]
            rows += [between.projection("along", axis, motion)] if motion else []
            continue
        if isinstance(joint, PinInSlot):
            axis = _axis(kinematics, between.first, joint)
            rows.append(between.projection("normal", axis.turned()))
            continue
        rows += between.coincidence()
        if isinstance(joint, Fixed):
            rows.append(between.angle(held))
        elif motion is not None:
            rows.append(between.angle(motion))
    return rows


def _gear_row(kinematics: Kinematics, name: str) -> ClosingRow:
    """Return α_2 - ratio α_1 - offset = 0."""
    gear, names = kinematics.numbers.gears[name], kinematics.tree.coordinates
    partials: dict[str, Scalar] = {}
    value: Scalar = -gear.offset
    rate: Scalar = 0.0
    bias: Scalar = 0.0
    for factor, body in coupled(kinematics.numbers, gear):
        frame = kinematics.carried[body]
        value, rate = value + factor * frame.angle, rate + factor * frame.spin
        bias = bias + factor * frame.spin_bias
        for coordinate, share in frame.spin_partials.items():
            partials[coordinate] = partials.get(coordinate, 0.0) + factor * share
    found = {n: p for n, p in partials.items() if n in names and not is_zero(p)}
    return ClosingRow(name, "angle", value, rate, found, bias)


def _axis(kinematics: Kinematics, guide: str, joint: Prismatic | PinInSlot) -> FrameVector:
    return FrameVector(kinematics.orientations, {guide: unit(joint.axis)})


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
        self.jacobian = [[row.partials.get(n, 0.0) for n in self.names] for row in self.rows]
        self.responses = solve_symmetric(mass_matrix, self.jacobian)
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
                for factor, journal, bearing in sides(k.numbers, k.numbers.gears[name]):
                    turn = factor * moment
                    found.couples.append(Interaction(bearing, journal, (0.0, 0.0), -turn, turn))
                continue
            joint, between = k.numbers.joints[name], _Between(k, name)
            (_, here), (_, there) = ends(joint)
            turning = parts.get("angle", 0.0)
            force: Pair = (parts.get("x", 0.0), parts.get("y", 0.0))
            offset: Scalar = 0.0
            if isinstance(joint, Prismatic | PinInSlot):
                axis = _axis(k, between.first, joint)
                pushed = axis.turned().scaled(parts["normal"])
                if "along" in parts:
                    pushed = pushed + axis.scaled(parts["along"])
                force = pushed.world()
                offset = cross(between.gap.world(), force)  # the guide's point is elsewhere
            found.interactions[name] = Interaction(here, there, force, -turning - offset, turning)
            if joint.type in HOLDING:
                found.moments[name] = turning
            if name in drivers:
                effort = turning if isinstance(joint, Revolute) else parts["along"]
                found.efforts[drivers[name]] = effort
        return found

    def _multipliers(self, right: list[Scalar]) -> list[Scalar]:
        kinds = ["angle" if row.part == "angle" else "length" for row in self.rows]
        return solve_semidefinite(self.matrix, right, kinds)

    def _along(self, i: int, vector: Sequence[Scalar]) -> Scalar:
        """Return the product of row i of J and a vector."""
        total: Scalar = 0.0
        for entry, value in zip(self.jacobian[i], vector, strict=True):
            if not (is_zero(entry) or is_zero(value)):
                total = total + entry * value
        return total

    def _moved(self, vector: Sequence[Scalar], multipliers: Sequence[Scalar]) -> list[Scalar]:
        moved = list(vector)
        for response, multiplier in zip(self.responses, multipliers, strict=True):
            for i, value in enumerate(response):
                if not is_zero(value):
                    moved[i] = moved[i] + value * multiplier
        return moved
