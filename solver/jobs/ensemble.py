"""The job of kind ``ensemble``: one set of parameters from many perturbed starts."""

from typing import Annotated, Literal

from pydantic import Field

from jointplay.solver.jobs.study import SectionStudyJob


class EnsembleJob(SectionStudyJob):
    """The sections of many runs that differ in their start alone; the first is unperturbed."""

    kind: Literal["ensemble"]
    members: Annotated[
        int, Field(ge=1, le=10**12, description="number of starts", json_schema_extra={"unit": "1"})
    ]
    spread: Annotated[
        float,
        Field(
            ge=0.0,
            le=1.0,
            description=(
                "standard deviation of the start's perturbation: positions relative to the finest"
                " clearance, velocities to that per period/2pi"
            ),
            json_schema_extra={"unit": "1"},
        ),
    ] = 1e-3
    seed: Annotated[
        int,
        Field(
            ge=0,
            le=2**53 - 1,
            description="of the perturbations; the same gives the same",
            json_schema_extra={"unit": "1"},
        ),
    ] = 0
