"""Parts of a calibration document: what may move, what it shall give, how long to search."""

from typing import Annotated, Literal

from pydantic import Field

from jointplay.solver.quantities.units import Name, Strict, quantity

Statistic = Literal["maximum", "minimum", "range", "maximum_time", "minimum_time"]
UNIT = "the parameter's unit"
CHANNEL_UNIT = "the channel's unit, or s of a time"

CHAINS = 64
"""Chains that spread over what fits equally well, in two halves: whole groups of lanes."""

Bound = Annotated[float, quantity(UNIT)]
Value = Annotated[float | None, quantity(CHANNEL_UNIT)]
Seconds = Annotated[float, quantity("s")]
Ratio = Annotated[float, quantity("1")]
Count = Annotated[int, quantity("1")]


class FreeParameter(Strict):
    """A declared parameter that may move between two bounds."""

    minimum: Bound
    maximum: Bound
    spacing: Annotated[
        Literal["linear", "log"],
        Field(description="log: equal ratios count the same, for bounds above zero"),
    ] = "linear"


class CalibrationTarget(Strict):
    """One number that a channel shall give in a window of time; one of `value` and `between`."""

    channel: Annotated[str, Field(min_length=1, max_length=80)]
    statistic: Annotated[
        Statistic, Field(description="range: maximum less minimum; a time counts from the start")
    ] = "maximum"
    start: Annotated[Seconds, Field(alias="from", ge=0.0, le=1e12)] = 0.0
    stop: Annotated[Seconds, Field(alias="to", gt=0.0, le=1e12)]
    value: Value = None
    between: Annotated[
        list[float | None] | None,
        quantity(
            CHANNEL_UNIT,
            min_length=2,
            max_length=2,
            description="lowest and highest value that are as good as any; null: no limit there",
        ),
    ] = None
    sampled: Annotated[
        float | None,
        quantity(
            "s",
            gt=0.0,
            description="the source read the channel only at multiples of this; so do we, then",
        ),
    ] = None
    relative_tolerance: Annotated[
        float | None,
        quantity(
            "1",
            gt=0.0,
            le=10.0,
            description="what counts as a miss of one, as a share of the value; default 0.05",
        ),
    ] = None
    absolute_tolerance: Annotated[Value, Field(gt=0.0, description="the same in its unit")] = None
    weight: Annotated[
        Ratio,
        Field(ge=0.0, le=1e6, description="0: shown beside what the fit gives, but not fitted"),
    ] = 1.0
    note: Annotated[str, Field(max_length=300)] = ""


class CalibrationCase(Strict):
    """One setting of the scene's parameters under which numbers are known."""

    name: Annotated[str, Field(max_length=80)] = ""
    parameters: Annotated[dict[Name, float | str | None], quantity(UNIT, max_length=64)] = {}
    targets: Annotated[list[CalibrationTarget], Field(min_length=1, max_length=256)]


class Search(Strict):
    """Length of the search: differential evolution, from a Latin hypercube."""

    population: Annotated[Count, Field(ge=2, le=1000, description="candidates a parameter")] = 15
    generations: Annotated[Count, Field(ge=1, le=10_000)] = 60
    seed: Annotated[Count, Field(ge=0, lt=2**63)] = 0
    most_steps: Annotated[
        Count,
        Field(
            ge=100,
            le=10**9,
            description="of a run: one that needs more counts as failed, so that none holds up all",
        ),
    ] = 200_000


class Spread(Strict):
    """Limit of an equally good fit, and length of the search for more of them."""

    factor: Annotated[
        Ratio,
        Field(
            ge=1.0,
            le=100.0,
            description="a cost up to this times the best, or up to 1 (the tolerances), is as good",
        ),
    ] = 1.2
    generations: Annotated[Count, Field(ge=2, le=10_000)] = 60
