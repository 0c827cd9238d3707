"""Points that are a map over two axes, a parameter along each."""

from typing import Annotated

from pydantic import Field

from jointplay.solver.kinds.job import MechanismJob
from jointplay.solver.kinds.limits import MOST_POINTS, check_count
from jointplay.solver.kinds.points import Points, plane
from jointplay.solver.kinds.values import Values, axis, count
from jointplay.solver.quantities.units import Name, Strict


class Along(Strict):
    """A parameter that varies along an axis."""

    parameter: Annotated[Name, Field(description="a declared parameter of the scene")]
    values: Annotated[
        Values, Field(description="its values: a list, or {'from', 'to', 'count', 'spacing'}")
    ]


class MapJob(MechanismJob):
    """Fields of a kind whose points are a map."""

    along: Annotated[Along, Field(description="what varies along x")]
    by: Annotated[Along, Field(description="what varies along y")]


def points_of_map(job: MapJob, most: int = MOST_POINTS) -> Points:
    """Return the points of a map, coarse to fine; see `Kind.admit` for how they are refused."""
    check_count(count(job.by.values) * count(job.along.values), "/by/values", most)
    y, x = (
        axis(one.parameter, one.values, f"{place}/parameter", f"{place}/values")
        for place, one in (("/by", job.by), ("/along", job.along))
    )
    return plane(y, x, "/by")
