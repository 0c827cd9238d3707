"""The document of a continuation."""

from typing import Annotated, Literal

from pydantic import Field

from jointplay.solver.kinds.job import Job, Observables
from jointplay.solver.kinds.section import ChannelSection
from jointplay.solver.kinds.start_state import StartState
from jointplay.solver.kinds.values import Range
from jointplay.solver.quantities.units import Name, Strict, quantity

USUAL_TOLERANCE = 1e-11


class AlongSecond(Strict):
    """A second parameter over which special orbits are followed."""

    parameter: Annotated[Name, Field(description="a declared parameter of the scene")]
    values: Annotated[
        Range,
        Field(
            description=(
                "its range, which includes the scene's value, and how many orbits a curve may have"
                " in each direction: {'from', 'to', 'count'}"
            )
        ),
    ]
    labels: Annotated[
        list[Literal["LP", "PD", "NS", "GR"]],
        Field(min_length=1, max_length=4, description="special orbits that are followed"),
    ] = ["LP", "PD", "NS", "GR"]
    curves: Annotated[
        int,
        quantity(
            "1", ge=1, le=16, description="most curves, in the order of the first branch's orbits"
        ),
    ] = 4


class ContinuationJob(Job):
    """A branch of periodic orbits, stable or not, with its bifurcations."""

    kind: Literal["continuation"]
    parameter: Annotated[Name, Field(description="a declared parameter of the scene")]
    values: Annotated[
        Range,
        Field(
            description=(
                "its range, and how many orbits a branch may have in each direction: {'from', 'to',"
                " 'count'}"
            )
        ),
    ]
    at: Annotated[
        float | None,
        quantity(
            "the parameter's unit",
            description="value at which the branch begins; default: the first of the range",
        ),
    ] = None
    period: Annotated[
        int,
        quantity(
            "periods",
            ge=1,
            le=64,
            description="of the drivers, or crossings of the section, after which orbits are back",
        ),
    ] = 1
    section: Annotated[
        ChannelSection | None,
        Field(
            description=(
                "where orbits of a mechanism that nothing drives are looked at: each time a channel"
                " crosses a value, {'channel', 'value', 'direction'}; others at crank angle 0"
            )
        ),
    ] = None
    settle: Annotated[
        int,
        quantity(
            "periods", ge=0, le=10**12, description="of motion before an orbit is sought from it"
        ),
    ] = 100
    state: StartState = None
    orbits: Annotated[
        int,
        quantity(
            "1",
            ge=1,
            le=16,
            description=(
                "orbits at which branches begin, at most; several are sought in the motion that"
                " follows 'settle', chaotic or not"
            ),
        ),
    ] = 1
    largest_step: Annotated[
        float,
        quantity(
            "1", ge=1e-4, le=0.5, description="largest step along a branch, a share of the range"
        ),
    ] = 0.03
    doublings: Annotated[
        int,
        quantity(
            "1", ge=0, le=6, description="period doublings behind which branches are followed, too"
        ),
    ] = 0
    branch_points: Annotated[
        int,
        quantity(
            "1",
            ge=0,
            le=6,
            description="branch points of the first branch whose other branches are followed, too",
        ),
    ] = 0
    second: Annotated[
        AlongSecond | None,
        Field(
            description=(
                "a second parameter, over which special orbits of the first branch are followed:"
                " {'parameter', 'values', 'labels', 'curves'}"
            )
        ),
    ] = None
    observables: Observables = None
    record: Annotated[
        int | None,
        quantity(
            "1",
            ge=2,
            le=10**12,
            description=(
                "orbits of a branch at most, special ones counted; default: four times the count"
            ),
        ),
    ] = None

    @property
    def usual_tolerance(self) -> float:
        """Tolerance where none is given: derivatives are differences of runs."""
        return USUAL_TOLERANCE

    @property
    def named_channels(self) -> list[str]:
        """See `MechanismJob.named_channels`."""
        section = [] if self.section is None else [self.section.channel]
        return [*section, *(self.observables or [])]
