"""A cam and its follower, with play or without: what flat faces and rollers have in common.

With play the depth is what the profile lacks of the distance, less the lash; a roller's is measured
along the cam's normal, and so exact to first order in it. Both bodies are pushed at one point,
where the cam's surface is, a lash inside of the profile, or the roller's; and along the gradient of
the depth, so that the work of the forces is that of depth and slip.
"""

import math
from abc import abstractmethod
from collections.abc import Iterator, Mapping
from typing import Annotated, ClassVar, NamedTuple

import numpy as np
from pydantic import AfterValidator

from jointplay.records.arrays import Floats
from jointplay.solver.joints.contact import Contact, ContactGeometry, ContactState, surfaces
from jointplay.solver.joints.drawing import ANGLES, Curve
from jointplay.solver.joints.holding import Distance, Holding, Row
from jointplay.solver.joints.joint import AnyClearance, Joint, Table
from jointplay.solver.joints.wall import WALL
from jointplay.solver.laws.contact import LAWS as CONTACT_LAWS
from jointplay.solver.laws.contact import ContactLaw
from jointplay.solver.laws.force import Ends
from jointplay.solver.laws.friction import LAWS as FRICTION_LAWS
from jointplay.solver.laws.friction import FrictionLaw
from jointplay.solver.laws.function import Derivatives, Function
from jointplay.solver.laws.function.uses import Prescribed
from jointplay.solver.laws.function.whole_turn import TURN, repeats_every_turn, whole_turn
from jointplay.solver.quantities.frames import Pair, dot, plus, scaled
from jointplay.solver.quantities.registry import MemberOf
from jointplay.solver.quantities.scalars import Scalar, sine_cosine, sqrt
from jointplay.solver.quantities.units import PointReference, RadialClearance, Rule

SAMPLES = 720
"""Angles of a turn at which a profile is looked at."""
POINTED = 10.0
"""A cam whose profile is no larger than that many lashes is a point."""
ROUNDING = 1e-9
"""Share of a profile by which the radius of a cam that is a point may be below zero."""
CENTRED = 1e-300
"""Added to a distance (m), so that a roller in the cam's centre divides by no zero."""
CAPTION = "Follower of joint {} on its cam"
FOLLOWER = (("normal_force", "N", "force of the cam on its follower along the normal; < 0: pulls"),)
"""Channel of a follower without play, which is held both ways."""


class CamClearance(AnyClearance):
    """Play of a follower, which strikes its cam and may lift off.

    The cam's surface is `lash` inside of the profile, along its normal. A lash of zero is an ideal
    joint.
    """

    play_field: ClassVar[str] = "lash"
    lash: RadialClearance
    contact: Annotated[ContactLaw, MemberOf(CONTACT_LAWS, "law")]
    friction: Annotated[FrictionLaw, MemberOf(FRICTION_LAWS, "law")] | None = None

    @property
    def rules(self) -> tuple[Rule, ...]:
        """Rules that its numbers must keep."""
        return WALL


class Lift(NamedTuple):
    """Distance of a follower from where the profile has it."""

    distance: Distance
    """Its gradient is longer than 1 on a flank of a roller's cam."""
    profile: Derivatives
    """The profile and its derivatives at this angle, m."""


class CamJoint(Joint):
    """A cam and its follower: two points, and how far they are apart where both touch.

    `profile` is a function of an angle in the cam's axes, rad, that repeats after a turn: base
    radius and lift, m. A last knot within a millionth of a turn is taken to end it.
    """

    called: ClassVar[str] = "a cam and its follower"
    end_fields: ClassVar[tuple[str, str]] = ("cam", "follower")
    one_sided: ClassVar[bool] = True
    ideal_channels: ClassVar[Table] = FOLLOWER
    type: str
    cam: PointReference
    follower: PointReference
    profile: Annotated[Prescribed, AfterValidator(whole_turn)]
    clearance: CamClearance | None = None

    @abstractmethod
    def lift(self, between: Ends) -> Lift:
        """Return how far the follower is from its profile; `between` : its point from the cam's."""

    @abstractmethod
    def contact_geometry(self, between: Ends, found: Lift, lash: Scalar) -> ContactGeometry:
        """Return where both surfaces are nearest."""

    @abstractmethod
    def unreached(self, angles: Floats, profile: Derivatives) -> Iterator[tuple[str, str]]:
        """Yield why the follower, with its lash, does not reach the cam all around.

        A field, and the sentence.

        `profile` : (angles,) its values, m, and their derivatives, above zero.
        """

    def rows(self, held: Holding[Row], _motion: Derivatives | None) -> Iterator[Row]:
        """Yield: the follower is where the profile has it."""
        yield held.apart(self.lift(held.ends).distance)

    def contact(self, name: str, part: str, between: Ends, state: ContactState) -> Contact:
        """Evaluate the contact of the follower with its cam."""
        clearance = self.clearance
        assert clearance is not None  # noqa: S101  (narrows the type)
        geometry = self.contact_geometry(between, self.lift(between), clearance.lash)
        return surfaces(name, self.points, between, geometry, clearance, state)

    def ideal_values(self, between: Ends, force: Pair) -> tuple[Scalar, ...]:
        """Return the force on an ideal follower, N, along its normal out of the cam; < 0: pulls."""
        along = self.lift(between).distance.along
        return (dot(force, along) / sqrt(dot(along, along)),)

    def surface(self, facing: float) -> Curve:
        """Return where the cam ends: what the contact touches if the follower is on the profile.

        Uniform in the profile's angle. `facing` : angle in the follower's axes that is the
        profile's in the cam's, rad.
        """
        profile = np.broadcast_to(self.profile.at(ANGLES).value, ANGLES.shape)
        turned = ANGLES - facing
        (s, c), (sine, cosine) = sine_cosine(ANGLES), sine_cosine(turned)
        gap, still = scaled((c, s), profile), (0.0, 0.0)
        frames = ((1.0, 0.0), (cosine, sine))
        between = Ends(gap, still, still, frames, (0.0, turned))
        geometry = self.contact_geometry(between, self.lift(between), 0.0)
        lash = self.slack.play if self.slack else 0.0
        inside = plus(geometry.arm, scaled(geometry.normal, lash))
        return Curve(0, np.stack(plus(gap, inside), axis=1), filled=True)

    @property
    def size(self) -> float:
        """Bound on the profile, m: its value at zero, and what it gains from there at most."""
        slope = next(iter(self.profile.largest(TURN)), 0.0)
        return abs(float(self.profile.at(0.0).value)) + math.pi * slope

    @property
    def is_point(self) -> bool:
        """Whether the cam is hardly larger than its lash."""
        return self.clearance is not None and not self.size > POINTED * self.clearance.lash

    @property
    def loosened(self) -> Mapping[str, float]:
        """Largest violation of its constraint within its play, m."""
        return {} if self.clearance is None else {"normal": self.clearance.lash}

    def is_within(self, parts: Mapping[str, float], play: float) -> bool:
        """Return whether the follower is not in the cam; away from it there is room."""
        return -parts["normal"] <= play

    def functions(self) -> Iterator[tuple[str, Function]]:
        """Yield the profile."""
        yield "profile", self.profile

    def problems(self) -> Iterator[tuple[str, str]]:
        """Yield what keeps a profile from being a cam's."""
        profile = self.profile
        if any(rule.broken(profile) for rule in profile.rules):
            return
        if not profile.has_curvature:
            yield (
                "profile/between",
                "A follower needs a bounded acceleration that varies smoothly; give 'smooth'.",
            )
            return
        if not repeats_every_turn(profile):
            yield (
                "profile",
                "A profile repeats every turn of its cam, 2 pi rad; this one repeats after"
                f" {profile.period:g}. Give a periodic one, as a table from 0 to"
                " 6.283185307179586.",
            )
            return
        angles = np.linspace(0.0, TURN, SAMPLES, endpoint=False)
        found = Derivatives(*(np.broadcast_to(part, angles.shape) for part in profile.at(angles)))
        lowest = int(found.value.argmin())
        if found.value[lowest] <= 0.0:
            yield (
                "profile",
                f"The profile is {found.value[lowest]:.4g} m at {angles[lowest]:.3g} rad, but a"
                " follower keeps away from the cam's centre; add a base radius.",
            )
            return
        if self.clearance is not None and self.clearance.lash > found.value[lowest]:
            yield (
                "clearance/lash",
                f"A lash of {self.clearance.lash:g} m leaves nothing of a cam whose profile is"
                f" {found.value[lowest]:.4g} m at {angles[lowest]:.3g} rad; it must not be larger.",
            )
            return
        yield from self.unreached(angles, found)
