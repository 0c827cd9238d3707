"""The document of a calibration: which parameters may move, and which numbers they shall give."""

from typing import Annotated, Literal

from pydantic import Field

from jointplay.solver.calibration.document import (
    CalibrationCase,
    FreeParameter,
    Search,
    Spread,
)
from jointplay.solver.kinds.job import Job
from jointplay.solver.quantities.units import Name


class CalibrationJob(Job):
    """Parameters to be found, so that the cases give their targets."""

    kind: Literal["calibration"]
    description: Annotated[str, Field(max_length=2000, description="what it is for")] = ""
    parameters: Annotated[
        dict[Name, FreeParameter],
        Field(min_length=1, max_length=6, description="that may move, each between two bounds"),
    ]
    cases: Annotated[
        list[CalibrationCase],
        Field(
            min_length=1,
            max_length=64,
            description="settings of other parameters, each with the numbers that are known there",
        ),
    ]
    search: Annotated[Search, Field(description="length and seed of the search")] = Search()
    spread: Annotated[
        Spread, Field(description="limit of an equally good fit, and length of the search for it")
    ] = Spread()
