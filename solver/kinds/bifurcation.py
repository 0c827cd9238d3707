"""The kind ``bifurcation``: Poincare sections over the values of one parameter."""

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from jointplay.solver.kinds.idle_fields import check_idle
from jointplay.solver.kinds.limits import check_count
from jointplay.solver.kinds.points import Points, one_axis
from jointplay.solver.kinds.section_study import SectionStudy, SectionStudyJob
from jointplay.solver.kinds.values import Values, axis, count
from jointplay.solver.quantities.units import Name, quantity
from jointplay.solver.runs.study.plan import Study


class BifurcationJob(SectionStudyJob):
    """A bifurcation diagram: the sections of each value of a declared parameter."""

    kind: Literal["bifurcation"]
    parameter: Annotated[Name, Field(description="a declared parameter of the scene")]
    values: Annotated[
        Values, Field(description="its values: a list, or {'from', 'to', 'count', 'spacing'}")
    ]
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
        quantity(
            "1",
            ge=1,
            le=1024,
            description=(
                "contiguous segments that a continuation is cut into; the first value of each"
                " starts by the start rule; 1 is the strict continuation"
            ),
        ),
    ] = 8


class Bifurcation(SectionStudy[BifurcationJob]):
    """A point for each value, or two where a continuation goes both ways."""

    document = BifurcationJob
    results: ClassVar = ("points", "bifurcation", "poincare", "figures", "zarr")

    def admit(self, job: BifurcationJob) -> Study:
        """Check and fill in; see `Kind.admit`."""
        if job.continuation == "none":
            check_idle(job, "a 'continuation'", "chains")
        return super().admit(job)

    def points(self, job: BifurcationJob) -> Points:
        """Return the values."""
        twice = 2 if job.continuation == "both" else 1
        check_count(twice * count(job.values), "/values")
        return one_axis(axis(job.parameter, job.values, "/parameter", "/values"))

    def continuation(self, job: BifurcationJob) -> tuple[str, int]:
        """Return the direction, and the number of chains in each."""
        return job.continuation, job.chains
