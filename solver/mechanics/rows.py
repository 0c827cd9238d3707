"""Rows of constraints in absolute coordinates: one equation each, between markers on bodies."""

from dataclasses import dataclass
from typing import NamedTuple

from jointplay.solver.joints.holding import Distance
from jointplay.solver.laws.function import Derivatives
from jointplay.solver.quantities.frames import Pair, left, minus
from jointplay.solver.quantities.scalars import Scalar

RESTING = Derivatives(0.0, 0.0, 0.0)
"""Motion of what stays where it is."""


class Marker(NamedTuple):
    """A named point on a moving body, or on the ground (body index -1), in world axes.

    `arm` reaches from the centre of mass to the point; `position`, `velocity` are the point's,
    `angle` and `spin` the body's.
    """

    body: int
    arm: Pair
    position: Pair
    velocity: Pair
    angle: Scalar
    spin: Scalar
    turned: Pair = (1.0, 0.0)
    """Cosine and sine of the angle."""


@dataclass(frozen=True)
class Row:
    """One constraint, of a joint or a driver that turns a body, by its name.

    Its value, its Jacobian entries by coordinate index, and γ (eq. 22).
    `rate` is dΦ/dt; the acceleration level reads Φ_q q̈ = `gamma`.
    """

    joint: str
    part: str
    value: Scalar
    jacobian: dict[int, Scalar]
    rate: Scalar
    gamma: Scalar


def angle_row(name: str, first: Marker, second: Marker, motion: Derivatives) -> Row:
    """θ_second - θ_first - motion = 0."""
    jacobian: dict[int, Scalar] = {}
    value: Scalar = -motion.value
    rate: Scalar = -motion.slope
    for sign, marker in ((1.0, second), (-1.0, first)):
        if marker.body >= 0:
            jacobian[3 * marker.body + 2] = sign
            value = value + sign * marker.angle
            rate = rate + sign * marker.spin
    return Row(name, "angle", value, jacobian, rate, motion.curvature)


def projection_row(
    name: str,
    part: str,
    direction: Pair,
    motion: Derivatives,
    first: Marker,
    second: Marker,
) -> Row:
    """(r_second - r_first) · u - motion = 0, u fixed in the first body."""
    (ux, uy), (tx, ty) = direction, left(direction)
    gap, gap_rate = minus(second.position, first.position), minus(second.velocity, first.velocity)
    jacobian: dict[int, Scalar] = {}
    rate: Scalar = ux * gap_rate[0] + uy * gap_rate[1] - motion.slope
    gamma: Scalar = motion.curvature
    for sign, marker in ((1.0, second), (-1.0, first)):
        if marker.body < 0:
            continue
        k, (ax, ay) = 3 * marker.body, marker.arm
        jacobian[k], jacobian[k + 1] = sign * ux, sign * uy
        jacobian[k + 2] = sign * (uy * ax - ux * ay)
        gamma = gamma + sign * (marker.spin * marker.spin) * (ux * ax + uy * ay)
    if first.body >= 0:
        k, spin = 3 * first.body + 2, first.spin
        jacobian[k] = jacobian[k] + (tx * gap[0] + ty * gap[1])
        rate = rate + spin * (tx * gap[0] + ty * gap[1])
        gamma = gamma + (spin * spin) * (ux * gap[0] + uy * gap[1])
        gamma = gamma - 2.0 * spin * (tx * gap_rate[0] + ty * gap_rate[1])
    value = ux * gap[0] + uy * gap[1] - motion.value
    return Row(name, part, value, jacobian, rate, gamma)


def distance_row(name: str, first: Marker, second: Marker, found: Distance) -> Row:
    """Distance that stays zero: see `Distance`."""
    ux, uy = found.along
    jacobian: dict[int, Scalar] = {}
    gamma: Scalar = -found.bias
    for sign, marker, turning in ((1.0, second, found.on_second), (-1.0, first, found.on_first)):
        if marker.body < 0:
            continue
        k, (ax, ay) = 3 * marker.body, marker.arm
        jacobian[k], jacobian[k + 1] = sign * ux, sign * uy
        jacobian[k + 2] = sign * (uy * ax - ux * ay) + turning
        gamma = gamma + sign * (marker.spin * marker.spin) * (ux * ax + uy * ay)
    return Row(name, "normal", found.value, jacobian, found.rate, gamma)
