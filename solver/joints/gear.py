"""Gears and belts: the angle of one joint that turns follows that of another.

One equation couples the angles α of two joints, each that of the second body (the journal's) less
that of the first: α_2 - ratio α_1 - offset = 0. It is linear in the angles of the bodies: its
Jacobian is constant, and it does no work. Its multiplier is a couple on the second joint, and
-ratio times as much on the first: the pins do not feel the forces between teeth.

Source: the principle of virtual work; Shigley and Uicker 1980, Theory of Machines and Mechanisms
(signs of ratios).
"""

from collections.abc import Iterator, Mapping
from typing import Annotated, ClassVar

from jointplay.solver.joints.joint import Joint, Table
from jointplay.solver.quantities.scalars import Scalar
from jointplay.solver.quantities.units import Angle, Name, Rule, Strict, quantity

Coupled = tuple[Scalar, str]
"""A factor, and the body whose angle it multiplies."""
RATIO = (
    Rule(
        "ratio",
        lambda gear: gear.ratio == 0.0,
        lambda gear: "A ratio of 0 lets the second joint stand still; weld it, or give a ratio.",
    ),
)


class Gear(Strict):
    """Gears or a belt: the second joint's angle is `ratio` times the first's, plus `offset`.

    Both joints are revolute; a driver may turn one, if something else is left to move. An angle is
    the journal body's less the bearing body's. An external pair of wheels with radii R_1 and R_2
    has the ratio -R_1 / R_2, a belt or an internal one R_1 / R_2.
    """

    channels: ClassVar[Table] = (
        ("moment", "N m", "moment on the journal's body of the second joint"),
    )
    rules: ClassVar[tuple[Rule, ...]] = RATIO
    first: Name
    second: Name
    ratio: Annotated[float, quantity("1", ge=-1e4, le=1e4)]
    offset: Angle = 0.0

    def sides(self, joints: Mapping[str, Joint]) -> Iterator[tuple[Scalar, str, str]]:
        """Yield the factor of each joint's angle, and its second and first point."""
        factors: tuple[Scalar, Scalar] = (1.0, -self.ratio)
        for factor, name in zip(factors, (self.second, self.first), strict=True):
            first, second = joints[name].points
            yield factor, second, first

    def coupled(self, joints: Mapping[str, Joint]) -> Iterator[Coupled]:
        """Yield the factors of the angles of the bodies that it couples."""
        for factor, second, first in self.sides(joints):
            yield factor, second.split(".")[0]
            yield -factor, first.split(".")[0]
