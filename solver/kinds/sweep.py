"""The kind ``sweep``: peaks and statistics over any number of parameters."""

import math
from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import Field

from jointplay.records.failure import InvalidInput
from jointplay.solver.kinds.extremes_study import ExtremesStudy, ExtremesStudyJob
from jointplay.solver.kinds.job import Job
from jointplay.solver.kinds.limits import check_count
from jointplay.solver.kinds.points import Axis, Points, product
from jointplay.solver.kinds.values import UNIT, Values, axis, count
from jointplay.solver.quantities.units import Name, quantity

PointValues = Annotated[
    dict[Name, Annotated[float, quantity(UNIT)]], Field(min_length=1, max_length=64)
]


class GridOrList(Job):
    """A grid over parameters, or a list of their values."""

    grid: Annotated[
        dict[Name, Values] | None,
        Field(
            min_length=1,
            max_length=64,
            description="values by parameter: their Cartesian product, the first varies slowest",
        ),
    ] = None
    points: Annotated[
        list[PointValues] | None,
        Field(min_length=1, description="or one value of each parameter for every point"),
    ] = None


class SweepJob(ExtremesStudyJob, GridOrList):
    """Peaks and statistics at each point of a grid or list; one of `duration` and `periods`."""

    kind: Literal["sweep"]


class Sweep(ExtremesStudy[SweepJob]):
    """A point for each combination of values, or for each one that is listed."""

    document = SweepJob
    results: ClassVar = ("points", "sweep", "figures", "zarr")

    def points(self, job: SweepJob) -> Points:
        """Return the product of the values, or the points of the list."""
        if job.grid is not None and job.points is None:
            check_count(math.prod(count(values) for values in job.grid.values()), "/grid")
            axes = [
                axis(name, values, f"/grid/{name}", f"/grid/{name}")
                for name, values in job.grid.items()
            ]
            return product(axes, "/grid")
        if job.points is None or job.grid is not None:
            both = ", not both." if job.grid is not None else "."
            raise InvalidInput.at("/grid", f"Give one of 'grid' and 'points'{both}")
        check_count(len(job.points), "/points")
        return _listed(job.points)


def _listed(points: list[dict[str, float]]) -> Points:
    """Return points that are written one by one; each must name the same parameters."""
    names = list(points[0])
    for index, point in enumerate(points):
        if point.keys() != points[0].keys():
            lacking = [f"'{name}'" for name in names if name not in point]
            extra = [f"'{name}'" for name in point if name not in names]
            difference = " and ".join(
                text
                for text, found in (
                    (f"lacks {', '.join(lacking)}", lacking),
                    (f"has {', '.join(extra)} besides", extra),
                )
                if found
            )
            sentence = f"Point {index} {difference}; give every point the parameters of the first."
            raise InvalidInput.at(f"/points/{index}", sentence)
    written = np.arange(len(points), dtype=np.int64)
    return Points(
        tuple(
            Axis(
                name,
                f"/points/0/{name}",
                np.array([point[name] for point in points]),
                lambda at, name=name: f"/points/{at}/{name}",  # type: ignore[misc]
            )
            for name in names
        ),
        np.tile(written[:, None], (1, len(names))),
        lambda point: f"/points/{point}",
    )
