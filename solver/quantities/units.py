"""Numbers of a scene: units, bounds and rules, once, for schemas, checks and documentation.

``structural`` lists the values that change the equations themselves (friction switched off, the
Hertz exponent): the compiler writes these into a kernel. Every other number is run-time data.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Annotated, Any, Final

from pydantic import BaseModel, ConfigDict, Field


class Strict(BaseModel):
    """A frozen part of a document: unknown fields, wrong types, NaN and infinity are refused."""

    model_config = ConfigDict(strict=True, extra="forbid", frozen=True, allow_inf_nan=False)


@dataclass(frozen=True)
class Rule:
    """A relation that must not hold, at the field that would be mended.

    `broken` takes the part, whose numbers are floats or columns (one row a point of a study), and
    returns a truth value or an array of them; `sentence` takes a part with the floats of one scene.
    """

    field: str
    broken: Callable[[Any], Any]
    sentence: Callable[[Any], str]


def no_length(field: str) -> Rule:
    """Return the rule that a field, a `Direction`, is not too short to have one."""

    def is_short(part: Any) -> Any:
        x, y = getattr(part, field)
        return (abs(x) < SHORTEST) & (abs(y) < SHORTEST)

    return Rule(field, is_short, lambda _part: f"The {field} has no length; give e.g. [0, 1].")


def quantity(unit: str, *, structural: list[float] | None = None, **bounds: Any) -> Any:
    """Return the `Field` of a number with a unit; `bounds` are what a field takes."""
    extra: dict[str, Any] = {} if structural is None else {"structural": structural}
    return Field(json_schema_extra={"unit": unit, **extra}, **bounds)


NOT_COHERENT: Final = {
    **dict.fromkeys(("mm", "um", "µm", "cm", "km", "in"), "m"),
    **dict.fromkeys(("mm/s", "km/h"), "m/s"),
    **dict.fromkeys(("ms", "us", "µs", "min"), "s"),
    **dict.fromkeys(("deg", "°"), "rad"),
    **dict.fromkeys(("deg/s", "°/s", "rpm", "Hz"), "rad/s"),
    **dict.fromkeys(("kPa", "MPa", "GPa"), "Pa"),
    "g": "kg",
    "kN": "N",
    "N/mm": "N/m",
    "N mm": "N m",
}
"""Units that authors of scenes may have in mind, and the SI unit in which a number counts."""

Name = Annotated[str, Field(pattern=r"^[A-Za-z][A-Za-z0-9_-]{0,31}$")]
PointReference = Annotated[
    str, Field(pattern=r"^[A-Za-z][A-Za-z0-9_-]{0,31}\.[A-Za-z][A-Za-z0-9_-]{0,31}$")
]

Coordinate = Annotated[float, quantity("m", ge=-1e6, le=1e6, structural=[0.0])]
Point = Annotated[list[Coordinate], Field(min_length=2, max_length=2)]
Direction = Annotated[
    list[Annotated[float, quantity("1", ge=-1e6, le=1e6, structural=[0.0])]],
    Field(min_length=2, max_length=2),
]
SHORTEST = 1e-100
"""Length below which a direction is none: the squares of its parts are hardly numbers."""
Acceleration = Annotated[float, quantity("m/s^2", ge=-1e6, le=1e6)]
Angle = Annotated[float, quantity("rad", ge=-1e4, le=1e4)]
AngularVelocity = Annotated[float, quantity("rad/s", ge=-1e5, le=1e5)]
Length = Annotated[float, quantity("m", ge=-1e3, le=1e3)]
Velocity = Annotated[float, quantity("m/s", ge=-1e5, le=1e5)]
Mass = Annotated[float, quantity("kg", ge=1e-15, le=1e9)]
Inertia = Annotated[float, quantity("kg m^2", ge=1e-27, le=1e12)]
RadialClearance = Annotated[float, quantity("m", ge=0.0, le=1.0)]
Radius = Annotated[float, quantity("m", gt=0.0, le=1e3)]
