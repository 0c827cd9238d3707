"""Charts as the API shows them."""

from pydantic import BaseModel, Field

from jointplay.service.fields import in_unit
from jointplay.service.results.schemas import Described, Values
from jointplay.service.studies.schemas import Axis, Status


class Label(BaseModel):
    """A label that points have."""

    code: int = Field(description="As in `values` of the quantity.")
    name: str = Field(description="Such as period-2, chaotic, undecided or failed.")
    colour: str = Field(description="In the tiles, as #rrggbb.")
    points: int = Field(description="Points that have it so far.")


class Quantity(Described):
    """One quantity of the points."""

    name: str
    labels: list[Label] | None = Field(description="null: its points have values, not labels.")
    low: float | None = Field(
        description="Below it are 2 % of the values that are known; null: none is, or labels."
    )
    high: float | None = Field(description="Above it are 2 % of them.")
    shades: list[str] = Field(description="Colours of the tiles from low to high, as #rrggbb.")


class Chart(BaseModel):
    """A chart's axes and quantities, as far as it is computed."""

    complete: bool
    points: int
    ended: int = Field(description="Points that are done or have failed.")
    inherited: int = Field(
        description="Points among them that have the results of another point of their cell, whose"
        " corners were alike: of a chart that is refined."
    )
    x: Axis
    y: Axis
    levels: int = Field(
        description="Levels of tiles: of level z one has 256 cells a side, of"
        " 2^(levels - 1 - z) points each."
    )
    quantities: list[Quantity]


class PointQuantity(Described):
    """A quantity of one point."""

    value: float | None
    label: str | None = Field(description="Of a label, in words.")


class ChartPoint(BaseModel):
    """One point of a chart."""

    status: Status
    detail: str = Field(description="Why it failed, or the grounds of its verdict; may be empty.")
    quantities: dict[str, PointQuantity]


class Rectangle(BaseModel):
    """A quantity in a rectangle of a chart, row by row from its lower left corner."""

    unit: str
    columns: list[int] = Field(description="Index along x of the first point of each cell.")
    rows: list[int] = Field(description="Index along y of the first point of each cell.")
    values: list[Values] = Field(
        description="A row for each of `rows`; labels as codes; null: nothing is known."
    )


class Attractor(BaseModel):
    """One attractor, or motions that are not told apart, with one point that ends on it."""

    code: int = Field(description="As in `values` of the quantity attractor.")
    name: str = Field(description="Such as period-1 A, chaotic or failed.")
    colour: str = Field(description="In the tiles, as #rrggbb.")
    points: int
    share: float = Field(description="Of the points that have ended.")
    share_error: float = Field(
        description="Standard error of the share (Wilson 1927); not 0 where all points ended alike."
    )
    shares: list[float | None] | None = Field(
        description="At each value of `along`; null: nothing has ended there, or no parameter."
    )
    share_errors: list[float | None] | None = Field(description="Their standard errors.")
    point: int = Field(description="A point that ends on it.")
    column: int | None = Field(description="Index along x of that point; null: no map.")
    row: int | None = Field(description="Index along y of that point.")
    period: float | None = Field(description="Sections after which it recurs; 0: none.")
    lyapunov: float | None = in_unit("1/s", "Largest Lyapunov exponent at that point.")
    lyapunov_error: float | None = in_unit("1/s", "Its standard error.")
    mean: dict[str, float] = Field(
        description="Of each coordinate and its rate over a cycle, in SI units."
    )
    spread: dict[str, float] = Field(
        description="Root mean square deviation over a cycle, in SI units."
    )


class Along(BaseModel):
    """A parameter over which the same starts were computed."""

    parameter: str
    unit: str
    values: list[float] = Field(description="Ascending.")
    ended: list[int] = Field(description="Points of each value that are done or have failed.")


class Boundary(BaseModel):
    """Boundary between the basins, by the uncertainty exponent."""

    dimension: float = Field(description="1: a smooth line; towards 2: fractal.")
    error: float = Field(
        description="Standard error of the fit, and of what ends the growth of shares."
    )
    distances: list[int] = Field(description="Points between neighbours that are compared.")
    shares: list[float] = Field(description="Of points with a neighbour that ends elsewhere.")


class Attractors(BaseModel):
    """The attractors of many starts, as far as they are computed."""

    complete: bool
    points: int
    ended: int = Field(description="Points that are done or have failed.")
    along: Along | None = Field(description="null: the shares are not over a parameter.")
    attractors: list[Attractor]
    boundary: Boundary | None = Field(description="null: no map, or too few points tell it.")
