"""A point at a straight wall: the corner of a slider in its guide, or a pin in a slot.

The wall's normal n is fixed in the guide and points out of it; t = (-n_y, n_x). Both bodies are
pushed where the point is, so that the energy ledger closes: with r and d from the slider's and the
guide's points to there, the force f = -F_n n + F_t t on the slider has the moments r x f about the
slider's point and -(d x f) about the guide's. A pin's point is where it is nearest to the wall.

Source: Flores, Leine and Glocker 2010, Multibody System Dynamics 23:165 (gaps of the corners).
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from jointplay.solver.laws.fit import Fit
from jointplay.solver.laws.force import Ends
from jointplay.solver.mechanics.frames import (
    WORLD,
    Pair,
    cross,
    dot,
    left,
    plus,
    scaled,
    turned,
    unit,
)
from jointplay.solver.mechanics.play import Contact, Interaction, rub
from jointplay.solver.quantities.scalars import Scalar, select_positive, sine_cosine
from jointplay.solver.scene.joints import PinClearance, PinInSlot, Prismatic, SliderClearance
from jointplay.solver.scene.pairs import CORNERS, WALLS, ContactPair
from jointplay.solver.scene.references import ends


@dataclass(frozen=True)
class Straight:
    """The fit of a point at a wall, which has no radii: laws that need them are refused."""

    bearing_radius: Scalar = math.nan
    radial_clearance: Scalar = math.nan
    bearing_width: Scalar = math.nan


STRAIGHT: Fit = Straight()


def wall_contact(
    pair: ContactPair,
    joint: Prismatic | PinInSlot,
    between: Ends,
    mode: Scalar,
    impact_rate: Scalar,
    inner: Sequence[Scalar] = (),
) -> Contact:
    """Evaluate the contact of one pair of a guide or slot.

    `between` : the slider's point (or the pin's) against the guide's. `mode`, `impact_rate` (m/s),
    `inner` : see `contact` of a journal.
    """
    clearance = joint.clearance
    assert clearance is not None  # noqa: S101  (narrows the type)
    side = CORNERS[pair.part][1] if pair.part in CORNERS else WALLS[pair.part]
    n = scaled(left(turned(unit(joint.axis), between.turned[0])), side)
    if isinstance(joint, Prismatic) and isinstance(clearance, SliderClearance):
        reach = 0.5 * clearance.height
        r = _corner(joint, clearance, pair.part, between.turned[1])
    elif isinstance(clearance, PinClearance):
        reach = clearance.pin_radius
        r = scaled(n, reach)
    d = plus(between.gap, r)
    t = left(n)
    # of the slider's material there against the guide's
    velocity = plus(
        between.rate,
        plus(
            scaled(left(r), between.spins[1]),
            scaled(left(d), -between.spins[0]),
        ),
    )
    centred = dot(n, d) - reach
    penetration = centred - clearance.wall_clearance
    rate, slip = dot(n, velocity), dot(t, velocity)
    depth = select_positive(mode, penetration, 0.0)
    normal_force = clearance.contact.normal_force(STRAIGHT, depth, rate, impact_rate)
    stored = clearance.contact.elastic_energy(STRAIGHT, depth)
    rubbing = rub(clearance.friction, normal_force, slip, inner)
    force = plus(scaled(n, -normal_force), scaled(t, rubbing.friction))
    (_, first), (_, second) = ends(joint)
    return Contact(
        pair.joint,
        "wall" if first.split(".")[0] == WORLD else "none",
        (centred, 0.0),
        (rate, 0.0),
        penetration,
        rate,
        n,
        normal_force,
        stored,
        rubbing.friction,
        slip,
        Interaction(
            first,
            second,
            force,
            moment_on_first=-cross(d, force),
            moment_on_second=cross(r, force),
        ),
        rubbing.inner,
        rubbing.inner_rates,
        rubbing.slip,
    )


def _corner(joint: Prismatic, slider: SliderClearance, corner: str, by: Pair) -> Pair:
    """Return the vector from a slider's point to a corner."""
    along, side = CORNERS[corner]
    (sine, cosine), (ux, uy) = sine_cosine(joint.angle), unit(joint.axis)
    axis = turned((cosine * ux + sine * uy, cosine * uy - sine * ux), by)
    return plus(
        scaled(axis, 0.5 * along * slider.length),
        scaled(left(axis), 0.5 * side * slider.height),
    )
