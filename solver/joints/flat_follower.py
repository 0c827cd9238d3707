"""A flat face on a cam.

With g from the cam's centre to the follower's point, u the normal of the face, from the cam
outwards, and α the direction of u in the cam's axes, the face is at u·g - p(α) from the profile p:
that is the cam's support function, so that the face touches it at p u + p' w, w to the left of u.

Source: Angeles and López-Cajún 1991, Optimization of Cam Mechanisms (support functions).
"""

from collections.abc import Iterator, Sequence
from functools import reduce
from typing import ClassVar, Literal

import numpy as np

from jointplay.records.arrays import Flags, Floats
from jointplay.solver.joints.cam import CAPTION, FOLLOWER, ROUNDING, CamJoint, Lift
from jointplay.solver.joints.contact import ContactGeometry
from jointplay.solver.joints.drawing import ANGLES, Curve, Drawing
from jointplay.solver.joints.holding import Distance
from jointplay.solver.joints.joint import MOMENT, Table
from jointplay.solver.joints.starts import GuideStart
from jointplay.solver.laws.force import Ends
from jointplay.solver.laws.function import Derivatives
from jointplay.solver.laws.function.whole_turn import TURN
from jointplay.solver.quantities.frames import Pair, dot, left, plus, scaled, turned, unit
from jointplay.solver.quantities.scalars import Scalar, direction_angle
from jointplay.solver.quantities.units import Direction, Rule, no_length

HALF = 0.615
"""Half the length of a face that is drawn, in means of the profile."""
AROUND = [TURN * k / 72 for k in range(72)]
"""Angles at which it is looked where a cam is thin, rad."""


class FlatFollower(CamJoint):
    """A flat face, through the follower's point, on a convex cam.

    `normal` points out of the cam, in the follower's axes. The profile is the distance of the face
    from the cam's centre, over the direction of that normal.
    """

    drawing: ClassVar[Drawing] = Drawing(picture="surface", caption=CAPTION)
    ideal_channels: ClassVar[Table] = (*FOLLOWER, *MOMENT)
    rules: ClassVar[tuple[Rule, ...]] = (no_length("normal"),)
    type: Literal["flat-follower"]
    normal: Direction

    @property
    def has_moment(self) -> bool:
        """True: the cam pushes beside its point."""
        return True

    @property
    def facing(self) -> Sequence[Scalar]:
        """The normal."""
        return self.normal

    def lift(self, between: Ends) -> Lift:
        """Return u·g - p(α)."""
        gap, velocity, (cam, follower) = between.gap, between.rate, between.spins
        u = self._face(between)
        w = left(u)
        x, y = self.normal
        p = self.profile.at(direction_angle(x, y) + between.angles[1] - between.angles[0])
        along, aside, turning = dot(u, gap), dot(w, gap), follower - cam
        on_follower = aside - p.slope
        bias = 2.0 * (follower * dot(w, velocity)) - (follower * follower) * along
        distance = Distance(
            along - p.value,
            u,
            p.slope,
            on_follower,
            dot(u, velocity) + on_follower * follower + p.slope * cam,
            bias - p.curvature * (turning * turning),
        )
        return Lift(distance, p)

    def ideal_values(self, between: Ends, force: Pair) -> tuple[Scalar, ...]:
        """Return the force along the normal, N, and its moment about the follower's point, N m."""
        (pushed,) = super().ideal_values(between, force)
        return pushed, pushed * self.lift(between).distance.on_second

    def contact_geometry(self, between: Ends, found: Lift, lash: Scalar) -> ContactGeometry:
        """Return where the surface touches the face.

        The surface's support function is the profile's less the lash, with the same slope.
        """
        u, p = self._face(between), found.profile
        touching = plus(scaled(u, p.value - lash), scaled(left(u), p.slope))
        arm = plus(touching, scaled(between.gap, -1.0))
        return ContactGeometry(scaled(u, -1.0), u, arm, -found.distance.value)

    def starts_in_wall(self, start: GuideStart) -> Flags | bool:
        """Return whether the cam's centre would be behind the face; see `Joint.starts_in_wall`.

        Where the cam is nearest to it: at which angle it starts is not known here.
        """
        rules = self.profile.rules
        if not np.any(start.offset < 0.0) or any(np.any(one.broken(self.profile)) for one in rules):
            return False
        least: Floats = reduce(np.minimum, (self.profile.at(angle).value for angle in AROUND))
        found: Flags = -start.offset >= least
        return found

    def curves(self) -> Iterator[Curve]:
        """Yield the cam's outline and the face, to its left if its normal points upwards."""
        x, y = scaled(unit(self.normal), HALF * float(np.mean(self.profile.at(ANGLES[1:]).value)))
        yield self.surface(facing=direction_angle(*self.normal))
        yield Curve(1, np.array([[y, -x], [-y, x]]))

    def unreached(self, angles: Floats, profile: Derivatives) -> Iterator[tuple[str, str]]:
        """Yield where the cam is not convex, or would not be a lash inside of its profile."""
        radius = profile.value + profile.curvature
        least = int(radius.argmin())
        lash = self.slack.play if self.slack else 0.0
        if radius[least] <= 0.0:
            yield (
                "profile",
                f"At {angles[least]:.3g} rad the cam is not convex (radius of curvature"
                f" {radius[least]:.4g} m), so that a flat face does not reach it; enlarge the base"
                " radius, or lift more slowly.",
            )
        elif lash > radius[least] * (1.0 + ROUNDING):
            yield (
                "clearance/lash",
                f"A lash of {lash:g} m leaves no convex cam: at {angles[least]:.3g} rad the"
                f" profile's radius of curvature is {radius[least]:.4g} m; it must not be larger.",
            )

    def _face(self, between: Ends) -> Pair:
        """Return u in the world's axes."""
        return turned(unit(self.normal), between.turned[1])
