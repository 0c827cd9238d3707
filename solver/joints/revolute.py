"""A pin: a journal in its bearing, with play or without (eqs 1-17 of the press paper).

With play the normal n points from the bearing's centre to the journal's. The contact forces act at
r_i + R_i n on the bearing and r_j + R_j n on the journal. These two points are a penetration apart,
so a free pair carries the small moment F_t δ; with it the work of the forces is exactly that of the
slip and of the penetration, and the energy ledger closes.
"""

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Annotated, ClassVar, Literal

import numpy as np

from jointplay.records.arrays import Flags
from jointplay.solver.joints.contact import Contact, ContactState, Interaction, friction_at
from jointplay.solver.joints.drawing import Drawing
from jointplay.solver.joints.holding import Holding, Row
from jointplay.solver.joints.joint import AnyClearance, Freedom, Joint
from jointplay.solver.joints.starts import JournalStart
from jointplay.solver.laws.contact import LAWS as CONTACT_LAWS
from jointplay.solver.laws.contact import ContactLaw
from jointplay.solver.laws.contact.film import Film
from jointplay.solver.laws.force import Ends
from jointplay.solver.laws.friction import LAWS as FRICTION_LAWS
from jointplay.solver.laws.friction import FrictionLaw
from jointplay.solver.laws.function import Derivatives
from jointplay.solver.quantities.registry import MemberOf
from jointplay.solver.quantities.scalars import Scalar, select_positive, sqrt
from jointplay.solver.quantities.units import PointReference, RadialClearance, Radius, Rule

CENTRED = 1e-300
"""Added to the eccentricity (m) and to its square (m^2), so that a centred journal divides by no
zero: its normal is 0."""
FITS = (
    Rule(
        "radial_clearance",
        lambda clearance: clearance.radial_clearance >= clearance.bearing_radius,
        lambda clearance: (
            f"A radial clearance of {clearance.radial_clearance:g} m leaves no journal in a"
            f" bearing of radius {clearance.bearing_radius:g} m; it must be smaller."
        ),
    ),
)


class Clearance(AnyClearance):
    """Play of a revolute joint: the journal moves inside the bearing and touches its wall.

    The journal's radius is the bearing's less the radial clearance. A radial clearance of zero is
    an ideal joint. Contact laws of lines need the bearing's width, its length along the axis.
    """

    play_field: ClassVar[str] = "radial_clearance"
    radial_clearance: RadialClearance
    bearing_radius: Radius
    bearing_width: Radius | None = None
    contact: Annotated[ContactLaw, MemberOf(CONTACT_LAWS, "law")]
    friction: Annotated[FrictionLaw, MemberOf(FRICTION_LAWS, "law")] | None = None

    @property
    def rules(self) -> tuple[Rule, ...]:
        """Rules that its numbers must keep, those of its contact law among them."""
        return (*FITS, *self.contact.clearance_rules)


class Revolute(Joint):
    """A pin joint between a point of the bearing body and a point of the journal body."""

    called: ClassVar[str] = "a pin"
    end_fields: ClassVar[tuple[str, str]] = ("bearing", "journal")
    drawing: ClassVar[Drawing] = Drawing(
        supported=True,
        size="bearing_radius",
        picture="journal",
        caption="Journal of joint {} in its bearing",
    )
    freedom: ClassVar[Freedom] = "turn"
    is_journal: ClassVar[bool] = True
    type: Literal["revolute"]
    bearing: PointReference
    journal: PointReference
    clearance: Clearance | None = None

    def rows(self, held: Holding[Row], motion: Derivatives | None) -> Iterator[Row]:
        """Yield: the points are one, and a driver turns the journal's body."""
        yield from held.coincident()
        if motion is not None:
            yield held.turned(motion)

    @property
    def size(self) -> float:
        """Radius of the bearing, m."""
        return 0.0 if self.clearance is None else self.clearance.bearing_radius

    @property
    def deepest(self) -> Scalar:
        """Depth beyond which the formula of its contact law does not go, m."""
        return (
            math.inf if self.clearance is None else self.clearance.contact.deepest(self.clearance)
        )

    @property
    def has_moment(self) -> bool:
        """Whether oil resists that the journal turns."""
        return self.clearance is not None and self.clearance.contact.is_film

    @property
    def loosened(self) -> Mapping[str, float]:
        """Largest violation of each part of its constraint within its play, m."""
        play = 0.0 if self.clearance is None else self.clearance.radial_clearance
        return {"x": play, "y": play}

    def is_within(self, parts: Mapping[str, float], play: float) -> bool:
        """Return whether the journal's centre is no farther from the bearing's, m."""
        return math.hypot(parts["x"], parts["y"]) <= play

    def contact(self, name: str, part: str, between: Ends, state: ContactState) -> Contact:
        """Evaluate the journal in its bearing: its centre against the bearing's."""
        clearance = self.clearance
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

        depth = select_positive(state.mode, penetration, 0.0)
        law = clearance.contact
        normal_force = law.normal_force(clearance, depth, penetration_rate, state.impact_rate)
        stored = law.elastic_energy(clearance, depth)
        seen = slip
        if clearance.friction is not None and not clearance.friction.slips_with_material:
            # eqs (5)-(7) literally: r^N = r^M + R n, so the points move with R dn/dt and the spins
            # of the bodies do not count; t . dn/dt is the orbiting velocity over the eccentricity
            seen = orbiting - clearance.radial_clearance * orbiting * inverse
        friction = friction_at(clearance.friction, normal_force, seen, state.inner)
        # eqs (13)-(17), on the journal: -(F_n n) + F_t t
        fx = -(normal_force * nx) - friction.force * ny
        fy = friction.force * nx - normal_force * ny
        on_bearing, on_journal = -(bearing_radius * friction.force), journal_radius * friction.force
        acting = Interaction(self.bearing, self.journal, (fx, fy), on_bearing, on_journal)
        film = law.film(clearance, between.gap, between.rate, spins)
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
            friction.force,
            slip,
            acting if film is None else _with_film(acting, film),
            friction.inner,
            friction.inner_rates,
            friction.slip,
            None if film is None else film.loss,
        )

    def start_problems(self, start: JournalStart) -> Iterator[tuple[str, str]]:
        """Yield why a journal cannot start there: out of its bearing, or deeper than its law."""
        if self.clearance is None:
            return
        x, y = start.eccentricity
        field = f"eccentricity/{int(abs(y) > abs(x))}"
        if self._is_outside(start):
            yield (
                field,
                f"An eccentricity of {math.hypot(x, y):g} m is beyond reach: the journal's centre"
                f" would be outside the bearing, whose radius is"
                f" {self.clearance.bearing_radius:g} m.",
            )
        elif self._is_too_deep(start):
            yield (
                field,
                f"At an eccentricity of {math.hypot(x, y):g} m the journal is deeper in its bearing"
                f" than {self.deepest:.3g} m, where the logarithm of the law"
                f" '{self.clearance.contact.title}' ends; start it less deep.",
            )

    def cannot_start(self, start: JournalStart) -> Flags | bool:
        """Return the same as truth values, where numbers may be columns."""
        found: Flags | bool = self._is_outside(start) | self._is_too_deep(start)
        return found

    def _is_outside(self, start: JournalStart) -> Flags:
        """Tell whether a journal would start with its centre outside the bearing."""
        assert self.clearance is not None  # noqa: S101  (narrows the type)
        x, y = start.eccentricity
        found: Flags = np.hypot(x, y) >= self.clearance.bearing_radius
        return found

    def _is_too_deep(self, start: JournalStart) -> Flags:
        """Tell whether a journal would start deeper than its contact law holds."""
        clearance = self.clearance
        assert clearance is not None  # noqa: S101  (narrows the type)
        x, y = start.eccentricity
        depth = np.hypot(x, y) - clearance.radial_clearance
        found: Flags = depth > self.deepest
        return found


def _with_film(acting: Interaction, film: Film) -> Interaction:
    """Return an interaction of journal and bearing with that of the oil between them."""
    (fx, fy), (on_x, on_y) = acting.force_on_second, film.force
    return replace(
        acting,
        force_on_second=(fx + on_x, fy + on_y),
        moment_on_first=acting.moment_on_first + film.moment_on_bearing,
        moment_on_second=acting.moment_on_second + film.moment_on_journal,
    )
