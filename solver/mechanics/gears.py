"""Gears and belts: the angle of one revolute joint follows that of another.

One equation couples the angles α of two joints, each that of the journal's body less that of the
bearing's: α_2 - ratio α_1 - offset = 0. It is linear in the angles of the bodies: its Jacobian is
constant, and it does no work. Its multiplier is a couple on the second joint, and -ratio times as
much on the first: the pins do not feel the forces between teeth.

Source: the principle of virtual work; Shigley and Uicker 1980, Theory of Machines and Mechanisms
(signs of ratios).
"""

from collections.abc import Iterator

from jointplay.solver.quantities.scalars import Scalar
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.joints import Gear, Revolute

Coupled = tuple[Scalar, str]
"""A factor, and the body whose angle it multiplies."""


def coupled(numbers: Scene, gear: Gear) -> Iterator[Coupled]:
    """Yield the factors of the angles of the bodies that a gear couples."""
    for factor, journal, bearing in sides(numbers, gear):
        yield factor, journal.split(".")[0]
        yield -factor, bearing.split(".")[0]


def sides(numbers: Scene, gear: Gear) -> Iterator[tuple[Scalar, str, str]]:
    """Yield the factor of each joint's angle, and the points of its journal and bearing."""
    factors: tuple[Scalar, Scalar] = (1.0, -gear.ratio)
    for factor, name in zip(factors, (gear.second, gear.first), strict=True):
        joint = numbers.joints[name]
        assert isinstance(joint, Revolute)  # noqa: S101  (checked on admission)
        yield factor, joint.journal, joint.bearing
