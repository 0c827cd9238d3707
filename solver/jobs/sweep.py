"""The job of kind ``sweep``: peaks and statistics over any number of parameters."""

from typing import Annotated, Literal

from pydantic import Field

from jointplay.solver.jobs.job import ChannelChoice, Job
from jointplay.solver.jobs.values import UNIT, Values
from jointplay.solver.quantities.units import Name

StatisticName = Literal[
    "mean",
    "root_mean_square",
    "standard_deviation",
    "mean_absolute",
    "quantile_05",
    "median",
    "quantile_95",
    "impacts",
    "largest_impact_force",
    "contact_share",
]
PointValues = Annotated[
    dict[Name, Annotated[float, Field(json_schema_extra=UNIT)]], Field(min_length=1, max_length=64)
]


class SweepJob(Job):
    """Peaks and statistics at each point of a grid or list; one of `duration` and `periods`."""

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
            description=(
                "what comes before does not count in peaks and statistics; in the unit of the"
                " duration"
            ),
            json_schema_extra={"unit": "s or periods"},
        ),
    ] = 0.0
    channels: Annotated[
        ChannelChoice | None,
        Field(
            description=(
                "channels whose peaks and statistics are kept, names or globs; default: the"
                " declared outputs, and normal force and penetration of each joint with clearance"
            )
        ),
    ] = None
    statistics: Annotated[
        list[StatisticName],
        Field(
            max_length=16,
            description=(
                "kept beside the peaks, over the time after settling: impacts (beginnings of"
                " contact), largest_impact_force (N) and contact_share (0 to 1) are of each joint"
                " with clearance, the others of each channel, in its unit"
            ),
            examples=[["mean", "root_mean_square"]],
        ),
    ] = []
    samples_per_period: Annotated[
        int,
        Field(
            ge=16,
            le=4096,
            description=(
                "equally spaced samples of the dense output that statistics of channels are made"
                " of, in a period, or in the scene's own time scale if the drivers have none"
            ),
            json_schema_extra={"unit": "1"},
        ),
    ] = 256
