"""Contact of two bodies of a joint with play: what both do to each other where they touch.

Signs: the normal n points out of the second body's material, the tangent is t = (-n_y, n_x);
penetration is positive in contact, its rate positive while approaching. Both bodies are pushed at
one point, so that the energy ledger closes: with r and d from the second and the first point to
there, a force f on the second body has the moments r x f about the second point and -(d x f) about
the first.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal, NamedTuple, Protocol

from jointplay.solver.laws.contact import ContactLaw
from jointplay.solver.laws.fit import Fit
from jointplay.solver.laws.force import Ends
from jointplay.solver.laws.friction import FrictionLaw
from jointplay.solver.quantities.frames import Pair, cross, dot, left, plus, scaled
from jointplay.solver.quantities.scalars import Scalar, select_positive


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


class Friction(NamedTuple):
    """Friction of a contact pair at its slip; SI units."""

    force: Scalar
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
    friction_slip: Scalar
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
        loss = -(self.friction_force * self.slip_velocity)
        return loss if self.film_loss is None else loss + self.film_loss


def friction_at(
    law: FrictionLaw | None, normal_force: Scalar, slip: Scalar, inner: Sequence[Scalar]
) -> Friction:
    """Evaluate a friction law, if there is one; the normal force in N, slip in m/s."""
    if law is None or law.is_off:
        return Friction(0.0, {}, ())
    force = law.friction_force(normal_force, slip, inner)
    rates = law.inner_rates(normal_force, slip, inner)
    named = {state.name: value for state, value in zip(law.inner_states, inner, strict=True)}
    return Friction(force, named, rates, slip)


class ContactState(NamedTuple):
    """Memory of the laws of a contact pair."""

    mode: Scalar
    """1 in contact, 0 apart, where there is no force whatever the penetration."""
    impact_rate: Scalar
    """Penetration rate latched at the onset of this contact, m/s."""
    inner: Sequence[Scalar] = ()
    """States of the friction law."""


@dataclass(frozen=True)
class Straight:
    """The fit of surfaces that are no journal in a bearing: laws that need radii are refused."""

    bearing_radius: Scalar = math.nan
    radial_clearance: Scalar = math.nan
    bearing_width: Scalar = math.nan


STRAIGHT: Fit = Straight()


class HasPlay(Protocol):
    """A clearance: its play, and the laws of the contact that there is then."""

    @property
    def contact(self) -> ContactLaw:
        """Law of the force along the normal."""

    @property
    def friction(self) -> FrictionLaw | None:
        """Law of the force along the tangent, if there is friction."""

    @property
    def play(self) -> Scalar:
        """Distance of centred bodies from touching, m."""


class ContactGeometry(NamedTuple):
    """Surfaces of a joint's bodies where they are nearest, world components."""

    normal: Pair
    """Unit normal out of the second body's material, into the first's."""
    push: Pair
    """Gradient of the penetration, with its sign changed: force on the second body per unit of
    normal force; -normal but where a penetration is no distance."""
    arm: Pair
    """From the second point to there, m."""
    centred: Scalar
    """Penetration, were there no play, m."""


def surfaces(
    name: str,
    points: tuple[str, str],
    between: Ends,
    geometry: ContactGeometry,
    clearance: HasPlay,
    state: ContactState,
    enclosure: Literal["wall", "none"] = "none",
) -> Contact:
    """Evaluate the contact of two surfaces.

    `name` : of the joint, `points` its points. `between` : the second against the first.
    """
    r, n = geometry.arm, geometry.normal
    d, t = plus(between.gap, r), left(n)
    # of the second body's material there against the first's
    velocity = plus(
        between.rate,
        plus(scaled(left(r), between.spins[1]), scaled(left(d), -between.spins[0])),
    )
    penetration = geometry.centred - clearance.play
    rate, slip = -dot(geometry.push, velocity), dot(t, velocity)
    depth = select_positive(state.mode, penetration, 0.0)
    normal_force = clearance.contact.normal_force(STRAIGHT, depth, rate, state.impact_rate)
    friction = friction_at(clearance.friction, normal_force, slip, state.inner)
    force = plus(scaled(geometry.push, normal_force), scaled(t, friction.force))
    return Contact(
        name,
        enclosure,
        (geometry.centred, 0.0),
        (rate, 0.0),
        penetration,
        rate,
        n,
        normal_force,
        clearance.contact.elastic_energy(STRAIGHT, depth),
        friction.force,
        slip,
        Interaction(
            *points,
            force,
            moment_on_first=-cross(d, force),
            moment_on_second=cross(r, force),
        ),
        friction.inner,
        friction.inner_rates,
        friction.slip,
    )
