"""A roller on a cam.

With g from the cam's centre to the roller's and α the direction of g in the cam's axes, the roller
is at |g| - p(α) from the profile p, the cam's pitch curve.

Source: Angeles and López-Cajún 1991, Optimization of Cam Mechanisms (pitch curves).
"""

from collections.abc import Iterator
from typing import ClassVar, Literal

from jointplay.records.arrays import Flags, Floats
from jointplay.solver.joints.cam import CAPTION, CENTRED, ROUNDING, CamJoint, Lift
from jointplay.solver.joints.contact import ContactGeometry
from jointplay.solver.joints.drawing import Curve, Drawing, circle
from jointplay.solver.joints.holding import Distance
from jointplay.solver.joints.starts import GuideStart
from jointplay.solver.laws.force import Ends
from jointplay.solver.laws.function import Derivatives
from jointplay.solver.quantities.frames import dot, left, plus, scaled
from jointplay.solver.quantities.scalars import Scalar, direction_angle, sqrt
from jointplay.solver.quantities.units import Radius


class RollerFollower(CamJoint):
    """A roller about the follower's point, on a cam.

    The profile is the distance of the roller's centre from the cam's, over the direction in which
    it lies.
    """

    drawing: ClassVar[Drawing] = Drawing(picture="surface", caption=CAPTION)
    needs_direction: ClassVar[bool] = True
    type: Literal["roller-follower"]
    roller_radius: Radius

    def lift(self, between: Ends) -> Lift:
        """Return |g| - p(α)."""
        (x, y), velocity, (cam, _) = between.gap, between.rate, between.spins
        cosine, sine = between.turned[0]
        p = self.profile.at(direction_angle(cosine * x + sine * y, cosine * y - sine * x))
        distance = sqrt(x * x + y * y)
        inverse = 1.0 / (distance + CENTRED)
        e = (x * inverse, y * inverse)
        f = left(e)
        slant = p.slope * inverse
        along = (e[0] - slant * f[0], e[1] - slant * f[1])
        outwards, around = dot(e, velocity), dot(f, velocity) * inverse
        turning = around - cam
        bias = distance * (around * around) + 2.0 * (slant * (outwards * around))
        found = Distance(
            distance - p.value,
            along,
            p.slope,
            0.0,
            dot(along, velocity) + p.slope * cam,
            bias - p.curvature * (turning * turning),
        )
        return Lift(found, p)

    def contact_geometry(self, between: Ends, found: Lift, lash: Scalar) -> ContactGeometry:
        """Return where the cam is nearest to the roller's centre.

        With L the distance along the radius and c the cosine of the angle between radius and
        normal, the depth is -L c, and falls along c ∇L + L ∇c.
        """
        p, (x, y), lift = found.profile, between.gap, found.distance
        square = p.value * p.value + p.slope * p.slope
        inverse = 1.0 / sqrt(square)
        cosine = p.value * inverse
        bent = p.slope * (p.slope * p.slope - p.value * p.curvature) * (inverse * inverse * inverse)
        apart = 1.0 / (x * x + y * y + CENTRED)
        around = scaled((-y, x), lift.value * bent * apart)
        push = plus(scaled(lift.along, cosine), around)
        n = scaled(push, -1.0 / sqrt(dot(push, push)))
        return ContactGeometry(n, push, scaled(n, self.roller_radius), -(lift.value * cosine))

    def starts_in_wall(self, start: GuideStart) -> Flags | bool:
        """Return whether the roller's centre is in the cam; see `Joint.starts_in_wall`."""
        lash = self.slack.play if self.slack else 0.0
        return -start.offset >= lash + self.roller_radius

    def curves(self) -> Iterator[Curve]:
        """Yield the cam's outline and the roller's."""
        yield self.surface(facing=0.0)
        yield Curve(1, circle(self.roller_radius))

    def unreached(self, angles: Floats, profile: Derivatives) -> Iterator[tuple[str, str]]:
        """Yield where nothing of the cam is left inside of the roller and the lash."""
        value, slope, curvature = profile
        bends = value**2 + 2.0 * slope**2 - value * curvature
        bends /= (value**2 + slope**2) ** 1.5
        most, lowest = int(bends.argmax()), int(value.argmin())
        lash = self.slack.play if self.slack else 0.0
        inside, exact = self.roller_radius + lash, 1.0 + ROUNDING
        wide = f"a roller of {self.roller_radius:g} m"
        if bends[most] * self.roller_radius >= 1.0:
            yield (
                "roller_radius",
                f"At {angles[most]:.3g} rad the path of the roller's centre has a radius of"
                f" {1.0 / bends[most]:.4g} m, within which {wide}"
                " cuts the cam away; make it smaller, or enlarge the base radius.",
            )
        elif self.roller_radius > value[lowest] * exact:
            yield (
                "roller_radius",
                f"The profile is {value[lowest]:.4g} m at {angles[lowest]:.3g} rad, where {wide}"
                " covers the cam's centre; make it smaller, or enlarge the base radius.",
            )
        elif inside > value[lowest] * exact or bends[most] * inside > exact:
            sharp = bends[most] * value[lowest] > 1.0
            at, room = (most, 1.0 / bends[most]) if sharp else (lowest, value[lowest])
            yield (
                "clearance/lash",
                f"A lash of {lash:g} m leaves nothing of the cam at {angles[at]:.3g} rad, where"
                f" {wide} leaves it {room - self.roller_radius:.4g} m; it must not be larger.",
            )
