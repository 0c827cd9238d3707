"""A point at a straight wall: the corner of a slider in its guide, or a pin in a slot.

The wall's normal n is fixed in the guide and points out of it. A pin's point is where it is nearest
to the wall.

Source: Flores, Leine and Glocker 2010, Multibody System Dynamics 23:165 (gaps of the corners).
"""

from collections.abc import Sequence
from typing import Literal, NamedTuple

from jointplay.solver.joints.contact import (
    Contact,
    ContactGeometry,
    ContactState,
    HasPlay,
    surfaces,
)
from jointplay.solver.laws.force import Ends
from jointplay.solver.quantities.frames import WORLD, Pair, dot, left, plus, scaled, turned, unit
from jointplay.solver.quantities.scalars import Scalar
from jointplay.solver.quantities.units import Rule

WALL = (
    Rule(
        "contact",
        lambda clearance: clearance.contact.needs_radii,
        lambda clearance: (
            f"The law '{clearance.contact.title}' takes its stiffness from the radii of journal and"
            " bearing, which a wall or a cam has not; give a stiffness (N/m^n)."
        ),
    ),
    Rule(
        "friction",
        lambda clearance: (
            clearance.friction is not None and not clearance.friction.slips_with_material
        ),
        lambda _clearance: (
            "The slip velocity 'as-published' is that of a journal in its bearing; at a wall or a"
            " cam take 'material'."
        ),
    ),
)
"""Rules of contact laws where no journal is in a bearing."""


def wall_normal(axis: Sequence[Scalar], side: float, between: Ends) -> Pair:
    """Return the normal of a wall on a side of an axis that is fixed in the first body."""
    return scaled(left(turned(unit(axis), between.turned[0])), side)


class Wall(NamedTuple):
    """A wall, and the point that may touch it."""

    normal: Pair
    arm: Pair
    """From the joint's second point to the point that touches, m."""
    reach: Scalar
    """Distance of the wall from the axis, without play, m."""


def at_wall(
    name: str,
    points: tuple[str, str],
    between: Ends,
    wall: Wall,
    clearance: HasPlay,
    state: ContactState,
) -> Contact:
    """Evaluate the contact of a point at a wall; see `surfaces`."""
    normal, arm, reach = wall
    centred = dot(normal, plus(between.gap, arm)) - reach
    enclosure: Literal["wall", "none"] = "wall" if points[0].split(".")[0] == WORLD else "none"
    geometry = ContactGeometry(normal, scaled(normal, -1.0), arm, centred)
    return surfaces(name, points, between, geometry, clearance, state, enclosure)
