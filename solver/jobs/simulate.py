"""The job of kind ``simulate``: one trajectory from the scene's start."""

from typing import Annotated, Literal

from pydantic import Field

from jointplay.solver.jobs.job import ChannelChoice, Job
from jointplay.solver.jobs.section import CrankSection


class SimulateJob(Job):
    """One trajectory from the scene's start."""

    kind: Literal["simulate"]
    duration: Annotated[
        float,
        Field(ge=1e-9, le=1e12, description="simulated time", json_schema_extra={"unit": "s"}),
    ]
    output_step: Annotated[
        float | None,
        Field(
            ge=1e-15,
            description="time between samples; default duration/2000",
            json_schema_extra={"unit": "s"},
        ),
    ] = None
    channels: ChannelChoice = ["*"]
    section: CrankSection = CrankSection()
    certificate: Annotated[
        bool,
        Field(description="say how far the result can be believed; does not change its bits"),
    ] = True
