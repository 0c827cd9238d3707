"""Points that are a map over two axes: a parameter or a number of the start along each."""

from dataclasses import replace
from typing import Annotated, Any

from pydantic import Field

from jointplay.solver.kinds.job import MechanismJob
from jointplay.solver.kinds.limits import MOST_POINTS, check_count
from jointplay.solver.kinds.points import Axis, Points, plane
from jointplay.solver.kinds.values import Values, axis, count
from jointplay.solver.quantities.units import Name, Strict
from jointplay.solver.scene import start_numbers
from jointplay.solver.scene.unions import discriminated_by, form, has


class Along(Strict):
    """A parameter that varies along an axis."""

    parameter: Annotated[Name, Field(description="a declared parameter of the scene")]
    values: Annotated[
        Values, Field(description="its values: a list, or {'from', 'to', 'count', 'spacing'}")
    ]

    @property
    def name(self) -> str:
        """Name of what varies."""
        return self.parameter


class AlongStart(Strict):
    """A number of the start that varies along an axis, or the phase of a driver."""

    start: Annotated[
        str,
        Field(
            pattern=start_numbers.PATTERN,
            max_length=96,
            description=(
                "a JSON pointer into the scene, such as '/start/joints/stop/eccentricity/0',"
                " '/start/points/mass.centre/0', '/start/angles/rod' or '/drivers/motor/position'"
            ),
        ),
    ]
    values: Annotated[
        Values, Field(description="its values: a list, or {'from', 'to', 'count', 'spacing'}")
    ]

    @property
    def name(self) -> str:
        """Name of what varies."""
        return start_numbers.name_of(self.start)


def _form_of_axis(value: Any) -> str | None:
    if has(value, "start"):
        return "start"
    return "parameter" if isinstance(value, dict | Along) else None


AnyAlong = Annotated[
    Annotated[Along, form("parameter")] | Annotated[AlongStart, form("start")],
    discriminated_by(
        _form_of_axis,
        "An axis must be an object with 'values', and 'parameter' or 'start'",
    ),
]


class MapJob(MechanismJob):
    """Fields of a kind whose points are a map."""

    along: Annotated[AnyAlong, Field(description="what varies along x")]
    by: Annotated[AnyAlong, Field(description="what varies along y")]

    @property
    def varied_starts(self) -> list[str]:
        """See `MechanismJob.varied_starts`."""
        return [one.start for one in (self.along, self.by) if isinstance(one, AlongStart)]


def points_of_map(job: MapJob, most: int = MOST_POINTS) -> Points:
    """Return the points of a map, coarse to fine; see `Kind.admit` for how they are refused."""
    check_count(count(job.along.values), "/along/values", most)
    check_count(count(job.by.values) * count(job.along.values), "/by/values", most)
    document = job.model_dump(include={"continuation", "refine"})
    return plane(_axis(job.by, "/by"), _axis(job.along, "/along"), "/by", document)


def _axis(one: Along | AlongStart, pointer: str) -> Axis:
    start = one.start if isinstance(one, AlongStart) else ""
    field = "start" if start else "parameter"
    found = axis(one.name, one.values, f"{pointer}/{field}", f"{pointer}/values")
    return replace(found, start=start)
