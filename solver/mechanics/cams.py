"""Cam and follower as geometry: how far the follower is from where the profile has it.

With g from the cam's centre to the follower's point and α the angle that the profile p is over:

- a flat face with normal u (from the cam outwards) is at u·g - p(α), α the direction of u in the
  cam's axes: p is the cam's support function, so that the face touches it at p u + p' w, w to the
  left of u;
- a roller's centre is at |g| - p(α), α the direction of g in the cam's axes.

Source: Angeles and López-Cajún 1991, Optimization of Cam Mechanisms (support functions and pitch
curves).
"""

from typing import NamedTuple

from jointplay.solver.laws.force import Ends
from jointplay.solver.laws.function import Derivatives
from jointplay.solver.mechanics.frames import Pair, dot, left, turned, unit
from jointplay.solver.quantities.scalars import Scalar, direction_angle, sqrt
from jointplay.solver.scene.cams import CamJoint, FlatFollower

CENTRED = 1e-300
"""Added to a distance (m), so that a roller in the cam's centre divides by no zero."""


class Lift(NamedTuple):
    """Distance of a follower from where the profile has it, and how it changes.

    Its rate is along · ġ + on_cam ω_1 + on_follower ω_2, its second derivative the same of the
    accelerations, plus `bias`.
    """

    value: Scalar
    """The distance, positive apart, m."""
    along: Pair
    """Direction of the distance, in the world's axes; of a roller longer than 1 on a flank."""
    on_cam: Scalar
    """Its derivative by the cam's angle, m."""
    on_follower: Scalar
    """Its derivative by the follower's angle, m."""
    rate: Scalar
    """Its rate, m/s."""
    bias: Scalar
    """Its second derivative without accelerations, m/s^2."""
    profile: Derivatives
    """The profile and its derivatives at this angle, m."""

    def less(self, distance: float, rate: float) -> "Lift":
        """Return the distance from where a follower is a distance (m) away, and its rate (m/s)."""
        return self._replace(value=self.value - distance, rate=self.rate - rate)


def lift(joint: CamJoint, between: Ends) -> Lift:
    """Return the distance of a follower; `between` : its point against the cam's."""
    if isinstance(joint, FlatFollower):
        return _flat(joint, between)
    return _roller(joint, between)


def pressed(joint: CamJoint, between: Ends, force: Pair) -> Scalar:
    """Return the force on an ideal follower, N, along its normal out of the cam; < 0: it pulls."""
    along = lift(joint, between).along
    return dot(force, along) / sqrt(dot(along, along))


def face(joint: FlatFollower, between: Ends) -> Pair:
    """Return the normal of a flat face in the world's axes, from the cam outwards."""
    return turned(unit(joint.normal), between.turned[1])


def _flat(joint: FlatFollower, between: Ends) -> Lift:
    gap, velocity, (cam, follower) = between.gap, between.rate, between.spins
    u = face(joint, between)
    w = left(u)
    x, y = joint.normal
    p = joint.profile.at(direction_angle(x, y) + between.angles[1] - between.angles[0])
    along, aside, turning = dot(u, gap), dot(w, gap), follower - cam
    on_follower = aside - p.slope
    bias = 2.0 * (follower * dot(w, velocity)) - (follower * follower) * along
    return Lift(
        along - p.value,
        u,
        p.slope,
        on_follower,
        dot(u, velocity) + on_follower * follower + p.slope * cam,
        bias - p.curvature * (turning * turning),
        p,
    )


def _roller(joint: CamJoint, between: Ends) -> Lift:
    (x, y), velocity, (cam, _) = between.gap, between.rate, between.spins
    cosine, sine = between.turned[0]
    p = joint.profile.at(direction_angle(cosine * x + sine * y, cosine * y - sine * x))
    distance = sqrt(x * x + y * y)
    inverse = 1.0 / (distance + CENTRED)
    e = (x * inverse, y * inverse)
    f = left(e)
    slant = p.slope * inverse
    along = (e[0] - slant * f[0], e[1] - slant * f[1])
    outwards, around = dot(e, velocity), dot(f, velocity) * inverse
    turning = around - cam
    bias = distance * (around * around) + 2.0 * (slant * (outwards * around))
    return Lift(
        distance - p.value,
        along,
        p.slope,
        0.0,
        dot(along, velocity) + p.slope * cam,
        bias - p.curvature * (turning * turning),
        p,
    )
