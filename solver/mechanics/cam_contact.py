"""A follower that touches its cam: depth, slip, and the forces between them.

The depth is what the profile lacks of the distance, less the lash; a roller's is measured along
the cam's normal, and so exact to first order in it. Both bodies are pushed at one point, where the
cam's surface is, a lash inside of the profile, or the roller's; and along the gradient of the
depth, so that the work of the forces is that of depth and slip.
"""

from collections.abc import Sequence

from jointplay.solver.laws.force import Ends
from jointplay.solver.mechanics.cams import CENTRED, Lift, face, lift
from jointplay.solver.mechanics.frames import Pair, cross, dot, left, plus, scaled
from jointplay.solver.mechanics.play import Contact, Interaction, rub
from jointplay.solver.mechanics.walls import STRAIGHT
from jointplay.solver.quantities.scalars import Scalar, select_positive, sqrt
from jointplay.solver.scene.cams import CamJoint, FlatFollower, RollerFollower
from jointplay.solver.scene.pairs import ContactPair


def cam_contact(
    pair: ContactPair,
    joint: CamJoint,
    between: Ends,
    mode: Scalar,
    impact_rate: Scalar,
    inner: Sequence[Scalar] = (),
) -> Contact:
    """Evaluate the contact of a follower with its cam.

    `between` : the follower's point against the cam's. `mode`, `impact_rate` (m/s), `inner` : see
    `contact` of a journal.
    """
    clearance = joint.clearance
    assert clearance is not None  # noqa: S101  (narrows the type)
    found, gap, spins = lift(joint, between), between.gap, between.spins
    if isinstance(joint, FlatFollower):
        centred, push, n, r = _face(joint, between, found, clearance.lash)
    elif isinstance(joint, RollerFollower):
        centred, push, n, r = _rim(joint, between, found)
    d = plus(gap, r)
    t = left(n)
    # of the follower's material there against the cam's
    velocity = plus(between.rate, plus(scaled(left(r), spins[1]), scaled(left(d), -spins[0])))
    penetration = centred - clearance.lash
    # the rate of a depth, whose gradient `push` opposes; the follower's own turning has the arm r
    rate = -(dot(push, velocity))
    slip = dot(t, velocity)
    depth = select_positive(mode, penetration, 0.0)
    normal_force = clearance.contact.normal_force(STRAIGHT, depth, rate, impact_rate)
    rubbing = rub(clearance.friction, normal_force, slip, inner)
    force = plus(scaled(push, normal_force), scaled(t, rubbing.friction))
    return Contact(
        pair.joint,
        "none",
        (centred, 0.0),
        (rate, 0.0),
        penetration,
        rate,
        n,
        normal_force,
        clearance.contact.elastic_energy(STRAIGHT, depth),
        rubbing.friction,
        slip,
        Interaction(
            joint.cam,
            joint.follower,
            force,
            moment_on_first=-cross(d, force),
            moment_on_second=cross(r, force),
        ),
        rubbing.inner,
        rubbing.inner_rates,
        rubbing.slip,
    )


def _face(
    joint: FlatFollower, between: Ends, found: Lift, lash: Scalar
) -> tuple[Scalar, Pair, Pair, Pair]:
    """Return depth without lash, its falling direction, the normal into the cam, and the arm.

    The arm ends where the surface touches the face: its support function is the profile's less
    the lash, with the same slope.
    """
    u = face(joint, between)
    touching = plus(scaled(u, found.profile.value - lash), scaled(left(u), found.profile.slope))
    return -found.value, u, scaled(u, -1.0), plus(touching, scaled(between.gap, -1.0))


def _rim(joint: RollerFollower, between: Ends, found: Lift) -> tuple[Scalar, Pair, Pair, Pair]:
    """Return the same of a roller.

    With L the distance along the radius and c the cosine of the angle between radius and normal,
    the depth is -L c, and falls along c ∇L + L ∇c.
    """
    p, (x, y) = found.profile, between.gap
    square = p.value * p.value + p.slope * p.slope
    inverse = 1.0 / sqrt(square)
    cosine = p.value * inverse
    bent = p.slope * (p.slope * p.slope - p.value * p.curvature) * (inverse * inverse * inverse)
    apart = 1.0 / (x * x + y * y + CENTRED)
    around = scaled((-y, x), found.value * bent * apart)
    push = plus(scaled(found.along, cosine), around)
    n = scaled(push, -1.0 / sqrt(dot(push, push)))
    return -(found.value * cosine), push, n, scaled(n, joint.roller_radius)
