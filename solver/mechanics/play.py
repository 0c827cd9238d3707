"""Journal and bearing: eccentricity, penetration, slip and the forces between them (eqs 1-17).

Signs: the normal n points from the bearing's centre to the journal's, the tangent is
t = (-n_y, n_x); penetration is positive in contact, its rate positive while approaching. The
contact forces act at r_i + R_i n on the bearing and r_j + R_j n on the journal. These two points
are a penetration apart, so a free pair carries the small moment F_t δ; with it the work of the
forces is exactly that of the slip and of the penetration, and the energy ledger closes.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal, NamedTuple

from jointplay.solver.laws.force import Ends
from jointplay.solver.laws.friction import FrictionLaw
from jointplay.solver.mechanics.frames import Pair
from jointplay.solver.quantities.scalars import Scalar, select_positive, sqrt
from jointplay.solver.scene.joints import Revolute

CENTRED = 1e-300
"""Added to the eccentricity (m) and to its square (m^2), so that a centred journal divides by no
zero: its normal is 0."""


@dataclass(frozen=True)
class Interaction:
    """A force on a point, its opposite on another (N), and a moment on the body of each (N m).

    Points are named as ``body.point``; components are the world's.
    """

    first: str
    second: str
    force_on_second: Pair
    moment_on_first: Scalar = 0.0
    moment_on_second: Scalar = 0.0


class Rubbing(NamedTuple):
    """Friction of a contact pair at its slip; SI units."""

    friction: Scalar
    inner: Mapping[str, Scalar]
    inner_rates: Sequence[Scalar]
    slip: Scalar = 0.0
    """Slip that the friction follows, m/s; 0 where there is none."""


@dataclass(frozen=True)
class Contact:
    """Action of a contact pair at one instant; SI units, world components."""

    joint: str
    """The joint that owns the pair."""
    enclosure: Literal["circle", "wall", "none"]
    """Enclosure of `eccentricity` while the gap is open: a circle as wide as the play, the half
    plane whose first component is less than it, or none that is known."""
    eccentricity: Pair
    """Journal's centre less the bearing's, m; of a point at a wall its way to the wall, and 0."""
    eccentricity_rate: Pair
    penetration: Scalar
    """e - c (eq. 3), or the depth in a wall: negative apart, m."""
    penetration_rate: Scalar
    normal: Pair
    normal_force: Scalar
    elastic_energy: Scalar
    friction_force: Scalar
    """F_t, on the joint's second body along t, N."""
    slip_velocity: Scalar
    """Velocity of the second body's material against the first's along t, m/s."""
    interaction: Interaction
    """At the points of the joint."""
    inner: Mapping[str, Scalar]
    """Inner states of the friction law, by name."""
    inner_rates: Sequence[Scalar]
    rubbing_slip: Scalar
    """Slip that the friction follows, m/s; 0 where there is none."""
    film_loss: Scalar | None = None
    """Power lost in the oil between journal and bearing, W, if there is any."""

    @property
    def contact_power(self) -> Scalar:
        """Power that goes into the contact, to be stored or lost, W."""
        return self.normal_force * self.penetration_rate

    @property
    def friction_loss(self) -> Scalar:
        """Power lost to friction, and in oil, W."""
        rubbed = -(self.friction_force * self.slip_velocity)
        return rubbed if self.film_loss is None else rubbed + self.film_loss


def rub(
    law: FrictionLaw | None, normal_force: Scalar, slip: Scalar, inner: Sequence[Scalar]
) -> Rubbing:
    """Evaluate a friction law, if there is one; the normal force in N, slip in m/s."""
    if law is None or law.is_off:
        return Rubbing(0.0, {}, ())
    friction = law.friction_force(normal_force, slip, inner)
    rates = law.inner_rates(normal_force, slip, inner)
    named = {state.name: value for state, value in zip(law.inner_states, inner, strict=True)}
    return Rubbing(friction, named, rates, slip)


def contact(
    name: str,
    joint: Revolute,
    between: Ends,
    mode: Scalar,
    impact_rate: Scalar,
    inner: Sequence[Scalar] = (),
) -> Contact:
    """Evaluate a journal in its bearing: its numbers, and its centre against the bearing's.

    `name` : of the joint.
    `mode` : 1 in contact, 0 apart, where there is no force whatever the penetration.
    `impact_rate` : penetration rate latched at the onset of this contact, m/s.
    `inner` : states of the friction law.
    """
    clearance = joint.clearance
    assert clearance is not None  # noqa: S101  (narrows the type)
    (ex, ey), (vx, vy), spins = between.gap, between.rate, between.spins
    square = ex * ex + ey * ey
    distance = sqrt(square) + CENTRED
    inverse = distance * (1.0 / (square + CENTRED))  # beside the root, not after it
    nx, ny = ex * inverse, ey * inverse  # eq. (2)
    penetration = distance - clearance.radial_clearance  # eq. (3)
    penetration_rate = vx * nx + vy * ny
    bearing_radius = clearance.bearing_radius
    journal_radius = bearing_radius - clearance.radial_clearance
    orbiting = nx * vy - ny * vx
    spinning = journal_radius * spins[1] - bearing_radius * spins[0]
    slip = orbiting + spinning

    depth = select_positive(mode, penetration, 0.0)
    law = clearance.contact
    normal_force = law.normal_force(clearance, depth, penetration_rate, impact_rate)
    stored = law.elastic_energy(clearance, depth)
    seen = slip
    if clearance.friction is not None and not clearance.friction.slips_with_material:
        # eqs (5)-(7) literally: r^N = r^M + R n, so the points move with R dn/dt and the spins
        # of the bodies do not count; t . dn/dt is the orbiting velocity over the eccentricity
        seen = orbiting - clearance.radial_clearance * orbiting * inverse
    rubbing = rub(clearance.friction, normal_force, seen, inner)
    friction = rubbing.friction
    # eqs (13)-(17), on the journal: -(F_n n) + F_t t
    fx = -(normal_force * nx) - friction * ny
    fy = friction * nx - normal_force * ny
    on_bearing, on_journal = -(bearing_radius * friction), journal_radius * friction
    film = law.film(clearance, between.gap, between.rate, spins)
    if film is not None:
        fx, fy = fx + film.force[0], fy + film.force[1]
        on_bearing = on_bearing + film.moment_on_bearing
        on_journal = on_journal + film.moment_on_journal
    return Contact(
        name,
        "circle",
        between.gap,
        between.rate,
        penetration,
        penetration_rate,
        (nx, ny),
        normal_force,
        stored,
        friction,
        slip,
        Interaction(
            joint.bearing,
            joint.journal,
            (fx, fy),
            moment_on_second=on_journal,
            moment_on_first=on_bearing,
        ),
        rubbing.inner,
        rubbing.inner_rates,
        rubbing.slip,
        None if film is None else film.loss,
    )
