"""The job of kind ``accuracy-study``: what every method and tolerance costs and buys."""

from typing import Annotated, Literal

from pydantic import Field

from jointplay.solver.integrators import METHODS
from jointplay.solver.jobs.job import MechanismJob
from jointplay.solver.quantities.roster import NameIn

TOLERANCES = (1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11)


class AccuracyStudyJob(MechanismJob):
    """A work-precision study: each method at each tolerance, against a reference run."""

    kind: Literal["accuracy-study"]
    duration: Annotated[
        float | None,
        Field(
            ge=1e-9,
            le=1e12,
            description="simulated time; default one period of the drivers, 1 s without drivers",
            json_schema_extra={"unit": "s"},
        ),
    ] = None
    methods: Annotated[
        list[Annotated[str, NameIn(METHODS)]],
        Field(
            min_length=1,
            max_length=16,
            description="also where jobs may not ask for them",
            default_factory=lambda: list(METHODS),
            json_schema_extra=lambda schema: schema.update(default=list(METHODS)),
        ),
    ]
    tolerances: Annotated[
        list[Annotated[float, Field(ge=1e-12, le=1e-2, json_schema_extra={"unit": "1"})]],
        Field(
            min_length=1,
            max_length=64,
            description="of the methods with error control; others go over fixed steps instead",
        ),
    ] = list(TOLERANCES)
