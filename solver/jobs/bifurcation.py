"""The job of kind ``bifurcation``: Poincare sections over the values of one parameter."""

from typing import Annotated, Literal

from pydantic import Field

from jointplay.solver.jobs.study import SectionStudyJob
from jointplay.solver.jobs.values import Values
from jointplay.solver.quantities.units import Name


class BifurcationJob(SectionStudyJob):
    """A bifurcation diagram: the sections of each value of a declared parameter."""

    kind: Literal["bifurcation"]
    parameter: Annotated[Name, Field(description="a declared parameter of the scene")]
    values: Values
    continuation: Annotated[
        Literal["none", "forward", "backward", "both"],
        Field(
            description=(
                "none: every value starts by the scene's start rule; forward, backward: from its"
                " neighbour's last state; both: one after the other, twice the points"
            )
        ),
    ] = "none"
    chains: Annotated[
        int,
        Field(
            ge=1,
            le=1024,
            description=(
                "contiguous segments that a continuation is cut into; the first value of each"
                " starts by the start rule; 1 is the strict continuation"
            ),
            json_schema_extra={"unit": "1"},
        ),
    ] = 8
