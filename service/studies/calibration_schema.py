"""Findings of a calibration, as the API shows them and the command line writes them."""

from typing import Any

from pydantic import BaseModel, ConfigDict, Field

from jointplay.service.fields import in_unit

OWN = "the parameter's unit"
CHANNEL = "the field `unit`"


class FoundParameter(BaseModel):
    """A parameter, and its spread over what fits equally well."""

    name: str
    unit: str
    best: float = in_unit(OWN, "Rounded to a few digits where that costs nothing.")
    quantiles: dict[str, float] = in_unit(OWN, "By 0.05, 0.25, 0.5, 0.75 and 0.95.")
    lowest: float = in_unit(OWN)
    highest: float = in_unit(OWN)
    open_ends: list[str] = Field(
        description="Of minimum and maximum, the bounds that the spread reaches: no end is known."
    )


class Correlation(BaseModel):
    """Which parameters make up for one another, over what fits equally well."""

    parameters: list[str]
    matrix: list[list[float]] = in_unit("1", "A row for each parameter.")


class FittedTarget(BaseModel):
    """A target, and what the best and the others that fit equally well give."""

    model_config = ConfigDict(serialize_by_alias=True)

    case: str
    channel: str
    statistic: str
    start: float = in_unit("s", alias="from")
    stop: float = in_unit("s", alias="to")
    unit: str
    value: float | None = in_unit(CHANNEL)
    between: list[float | None] | None = in_unit(CHANNEL)
    tolerance: float = in_unit(CHANNEL, "What counts as a miss of one.")
    weight: float = in_unit("1")
    fitted: float | None = in_unit(CHANNEL, "Of the best parameters; null: that run failed.")
    miss: float | None = in_unit("1", "In tolerances, with its sign.")
    lowest: float | None = in_unit(CHANNEL, "Of what fits equally well.")
    highest: float | None = in_unit(CHANNEL)
    roughness: float | None = in_unit(
        "1", "Change in tolerances between parameters a ten-thousandth of their range apart."
    )


class Members(BaseModel):
    """Parameters that fit equally well: a sample, evenly spread."""

    parameters: list[str]
    values: list[list[float]] = in_unit(OWN, "A row for each member.")


class SearchHistory(BaseModel):
    """Course of the search."""

    generations: int = Field(description="That were bred.")
    settled: bool = Field(description="Whether all candidates had become alike before its end.")
    candidates: int
    best_costs: list[float | None] = in_unit(
        "1", "Lowest cost after each generation; null: every run had failed so far."
    )
    failed: int = Field(description="Candidates that could not be computed.")
    spread_candidates: int
    spread_accepted: float = in_unit("1", "Share of the steps of the chains that were taken.")
    spread_settled: bool | None = Field(
        None,
        description="Whether each chain went through most of what fits equally well; else more may"
        " fit than ranges tell. Null: the version that computed it did not tell.",
    )


class Calibration(BaseModel):
    """Parameters that give the targets, how far each is known, and the search for them."""

    calibration: dict[str, Any] = Field(description="The job, with every default filled in.")
    digest: str
    solver: str
    cost: float = in_unit("1", "Root mean square of the misses, in tolerances.")
    equally_good_cost: float = in_unit("1", "Highest cost that counts as equally good.")
    misfits: bool = Field(
        description="Whether nothing fits: misses are larger than errors of the tolerances' size"
        " explain, of which one in a thousand would be so large."
    )
    parameters: list[FoundParameter]
    correlation: Correlation
    targets: list[FittedTarget]
    members: Members
    search: SearchHistory
