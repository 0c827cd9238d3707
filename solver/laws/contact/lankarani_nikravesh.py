"""Hertz contact with Lankarani-Nikravesh damping: the paper's eqs 8-10."""

from types import SimpleNamespace
from typing import Annotated, Any, Literal

from pydantic import Field

from jointplay.solver.quantities.scalars import Scalar, positive_part, power, sqrt
from jointplay.solver.quantities.units import Strict


class LankaraniNikravesh(Strict):
    """F_n = K δ^n + D δ̇ with D = 3 K (1 - c_e^2) δ^n / (4 δ̇⁻), never pulling.

    δ is the penetration depth (m), δ̇ its rate (positive while approaching, m/s), δ̇⁻ the rate at
    the onset of this contact (impact rate), c_e the restitution coefficient, K the stiffness.

    Without a given stiffness eq. 9 supplies it:
    K = 4 / (3 (h_i + h_j)) sqrt(R_i R_j / (R_i - R_j)), h = (1 - ν²) / E, both parts of one
    material. Eq. 9 is Hertz's law for spheres: it ignores the bearing's width, and tends to zero
    with the clearance growing.

    Assumes short, nearly elastic impacts. Fails for small c_e, where the restitution delivered is
    far above the one asked (0.725 for 0.5, 0.913 for 0.9), and in lasting contact, where
    1 / δ̇⁻ of the last onset scales the damping.

    Source: Lankarani and Nikravesh 1990, as printed in the press paper (Meccanica 2022), eqs 8-10.
    """

    law: Literal["lankarani-nikravesh"] = "lankarani-nikravesh"
    stiffness: Annotated[
        float | None,
        Field(gt=0.0, le=1e18, description="K; none: eq. 9", json_schema_extra={"unit": "N/m^n"}),
    ] = None
    youngs_modulus: Annotated[float, Field(gt=0.0, le=1e15, json_schema_extra={"unit": "Pa"})] = (
        2.07e11
    )
    poisson_ratio: Annotated[float, Field(ge=0.0, lt=0.5, json_schema_extra={"unit": "1"})] = 0.29
    exponent: Annotated[
        float, Field(ge=1.0, le=3.0, json_schema_extra={"unit": "1", "structural": [1.5]})
    ] = 1.5
    restitution: Annotated[float, Field(ge=0.0, le=1.0, json_schema_extra={"unit": "1"})] = 0.9
    impact_rate_floor: Annotated[
        float,
        Field(
            gt=0.0,
            le=1e3,
            description="smallest impact rate that the damping divides by",
            json_schema_extra={"unit": "m/s"},
        ),
    ] = 1e-3


def contact_stiffness(
    law: SimpleNamespace, bearing_radius: Scalar, radial_clearance: Scalar
) -> Scalar:
    """K of eq. 9 for a journal of radius R_j = R_i - c, or the stiffness given; N/m^n."""
    if law.stiffness is not None:
        return law.stiffness
    compliance = (1.0 - law.poisson_ratio * law.poisson_ratio) / law.youngs_modulus
    journal_radius = bearing_radius - radial_clearance
    radii = bearing_radius * journal_radius / radial_clearance
    return 4.0 / (3.0 * (compliance + compliance)) * sqrt(radii)  # eq. (9)


def normal_force(
    law: SimpleNamespace, stiffness: Scalar, depth: Scalar, rate: Scalar, impact_rate: Scalar
) -> tuple[Scalar, Scalar]:
    """Return the normal force F_n and its elastic part K δ^n, N.

    `depth` is the penetration where positive, m; `rate` its derivative, m/s; `impact_rate` the
    latched rate at onset, at least the floor, m/s.
    """
    elastic = stiffness * power(positive_part(depth), law.exponent)
    hysteresis = 0.75 * (1.0 - law.restitution * law.restitution)
    force = elastic * (1.0 + hysteresis * rate / impact_rate)  # eqs (8) and (10)
    return positive_part(force), elastic


def elastic_energy(law: SimpleNamespace, elastic: Scalar, depth: Scalar) -> Any:
    """Return the energy stored at a depth, K δ^(n+1) / (n + 1), J."""
    return elastic * positive_part(depth) / (law.exponent + 1.0)
