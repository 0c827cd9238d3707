"""The job of kind ``sweep``: peaks and ranges over any number of parameters."""

from typing import Annotated, Literal

from pydantic import Field

from solver.jobs.job import ChannelChoice, Job
from solver.jobs.values import UNIT, Values
from solver.scene.quantities import Name

PointValues = Annotated[
    dict[Name, Annotated[float, Field(json_schema_extra=UNIT)]], Field(min_length=1, max_length=64)
]


class SweepJob(Job):
    """Peaks and ranges at each point of a grid or list; one of `duration` and `periods`."""

    kind: Literal["sweep"]
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
    duration: Annotated[
        float | None,
        Field(ge=1e-9, le=1e12, description="simulated time", json_schema_extra={"unit": "s"}),
    ] = None
    periods: Annotated[
        float | None,
        Field(
            gt=0.0,
            le=1e12,
            description="or simulated time in periods of each point",
            json_schema_extra={"unit": "periods"},
        ),
    ] = None
    settle: Annotated[
        float,
        Field(
            ge=0.0,
            le=1e12,
            description="what comes before does not count in peaks; in the unit of the duration",
            json_schema_extra={"unit": "s or periods"},
        ),
    ] = 0.0
    channels: Annotated[
        ChannelChoice | None,
        Field(
            description=(
                "channels whose peaks are kept, names or globs; default: the declared outputs, and"
                " normal force and penetration of each joint with clearance"
            )
        ),
    ] = None
