"""Oil between a journal and its bearing: what films of short and long ones have in common."""

import math
from abc import abstractmethod
from typing import Annotated, ClassVar

from jointplay.solver.laws.contact.film import Film, Pair
from jointplay.solver.laws.contact.stiffness_and_dissipation import StiffnessAndDissipation
from jointplay.solver.laws.fit import Fit
from jointplay.solver.quantities.scalars import SLIGHT, Scalar, clamp_to_unit, minimum, sqrt
from jointplay.solver.quantities.units import Rule, quantity

BEARING = (
    Rule(
        "bearing_width",
        lambda clearance: clearance.bearing_width is None,
        lambda clearance: (
            f"The law '{clearance.contact.law}' needs the bearing's width; give a bearing_width in"
            " m."
        ),
    ),
    Rule(
        "contact",
        lambda clearance: clearance.contact.boundary_layer >= clearance.radial_clearance,
        lambda clearance: (
            f"A boundary layer of {clearance.contact.boundary_layer:g} m leaves no film in a"
            f" radial clearance of {clearance.radial_clearance:g} m; it must be smaller."
        ),
    ),
)


class OilFilm(StiffnessAndDissipation):
    """Film that bears where it is squeezed, with viscous friction, above dry contact.

    The journal's velocity V is taken in axes that turn with the mean of both spins; the film bears
    in the half of the bearing towards which it points, where the pressure is zero at both ends
    (Gümbel). Rotation is resisted by 2 π μ R³ L Δω / sqrt(c² - e²), e the eccentricity, c the
    radial clearance, μ the viscosity, L the bearing's width, R its radius. At a thickness below the
    boundary layer the film keeps the force of that thickness and fades to nothing where the
    surfaces meet, by a smooth step; there dry contact begins, of a stiffness and a dissipation law.

    Source of the transition, there a straight line: Flores, Ambrósio, Claro, Lankarani and Koshy
    2006, Mech. Mach. Theory 41:247.
    """

    is_film: ClassVar[bool] = True
    viscosity: Annotated[float, quantity("Pa s", gt=0.0, le=1e6, description="μ")]
    boundary_layer: Annotated[
        float,
        quantity(
            "m",
            gt=0.0,
            le=1.0,
            description="thickness from which the film fades, as of rough surfaces",
        ),
    ]

    @abstractmethod
    def pressed_area(self, fit: Fit) -> Scalar:
        """Return the square of the length along which oil is pressed out, m²."""

    @abstractmethod
    def pressure_integrals(self, x: Scalar, y: Scalar) -> Pair:
        """Return the force along V and to its left, over -μ L R V / c³ times `pressed_area`.

        (x, y) : the eccentricity over the clearance, along V and to its left.
        """

    def film(self, fit: Fit, eccentricity: Pair, rate: Pair, spins: Pair) -> Film:
        """Return the film's force and moments; the pressure's moments are shared by both bodies."""
        (ex, ey), (bearing, journal) = eccentricity, spins
        clearance, radius, width = fit.radial_clearance, fit.bearing_radius, fit.bearing_width
        mean = 0.5 * (bearing + journal)
        vx, vy = rate[0] + mean * ey, rate[1] - mean * ex
        square = vx * vx + vy * vy
        speed = sqrt(square)
        inverse = speed / (square + SLIGHT)
        sx, sy = vx * inverse, vy * inverse
        distance = sqrt(ex * ex + ey * ey)
        kept = minimum(1.0, (clearance - self.boundary_layer) / (distance + SLIGHT)) / clearance
        x, y = kept * (ex * sx + ey * sy), kept * (ey * sx - ex * sy)
        along, across = self.pressure_integrals(x, y)
        u = clamp_to_unit((clearance - distance) / self.boundary_layer)
        share = u * u * (3.0 - 2.0 * u)
        drag = share * self.viscosity * radius * width
        push = -(drag * self.pressed_area(fit) * speed / (clearance * clearance * clearance))
        fx, fy = push * (along * sx - across * sy), push * (along * sy + across * sx)
        turning = journal - bearing
        thin = clearance * sqrt(1.0 - x * x - y * y)
        viscous = 2.0 * math.pi * drag * (radius * radius) * turning / thin
        pressed = 0.5 * (ex * fy - ey * fx)
        return Film(
            (fx, fy),
            -viscous - pressed,
            viscous - pressed,
            viscous * turning - push * along * speed,
        )

    @property
    def clearance_rules(self) -> tuple[Rule, ...]:
        """Rules of the film and of the stiffness."""
        return (*BEARING, *self.stiffness.fit_rules)

    @property
    def needs_radii(self) -> bool:
        """True: oil is held by a bearing."""
        return True

    @property
    def title(self) -> str:
        """The film's name."""
        return self.law
