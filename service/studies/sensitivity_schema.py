"""Sensitivities as the API shows them, and what is asked of one output."""

from pydantic import BaseModel, ConfigDict, Field

from jointplay.records.sensitivity.analysis import Question, Side
from jointplay.service.fields import in_unit
from jointplay.service.results.schemas import Described, Partial, Values

OF_OUTPUT = "the field `unit`"
_ENDS = "Of its interval."
_OF_QUANTILES = "Of its interval; null: more points are needed."


class SensitivityQuery(BaseModel):
    """An output, a limit of it, and the confidence of intervals."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    output: str | None = Field(
        default=None,
        max_length=200,
        description="One of `outputs`, such as displacement.maximum; default: the first.",
    )
    limit: float | None = Field(
        default=None,
        allow_inf_nan=False,
        description="Of the output, in its unit: the answer says how probable it is beyond.",
    )
    failing: Side = Field(default="above", description="Which side of the limit is beyond it.")
    confidence: float = Field(
        default=0.95, ge=0.5, le=0.999, description="Probability of every interval."
    )

    def question(self) -> Question:
        """Return the question."""
        return Question(self.output, self.limit, self.failing, self.confidence)


class MeasureOfParameters(Described):
    """One measure of every parameter, in the order of `parameters`."""

    values: Values
    low: Values = Field(description=_ENDS)
    high: Values = Field(description=_ENDS)


class Quantiles(BaseModel):
    """Quantiles of the output."""

    shares: list[float] = in_unit("1", "Of the points, that lie below.")
    values: Values = in_unit(OF_OUTPUT)
    low: Values = in_unit(OF_OUTPUT, _OF_QUANTILES)
    high: Values = in_unit(OF_OUTPUT, _OF_QUANTILES)


class Failure(BaseModel):
    """Probability of the output beyond a limit."""

    limit: float = in_unit(OF_OUTPUT)
    failing: Side
    probability: float = in_unit("1")
    low: float = in_unit("1", "Of its interval, by Wilson.")
    high: float = in_unit("1", "Of its interval, by Wilson.")


class Rows(BaseModel):
    """Rows of the design; one counts only if every point of it gave the output."""

    used: int
    left_out: int = Field(description="Rows with a point that failed, or lacks the output.")
    waiting: int = Field(description="Rows that are not computed yet.")
    failed_points: int
    points_each: int = Field(description="Points of one row.")


class Sensitivity(Partial, Described):
    """Shares of parameters in one output, and its distribution."""

    design: str
    parameters: list[str]
    output: str
    outputs: list[str] = Field(description="All that can be asked for.")
    rows: Rows
    confidence: float = in_unit("1", "Probability of every interval.")
    resamples: int = Field(description="Of the rows, for the intervals of measures.")
    note: str = Field(description="Why there is less than was asked for; mostly empty.")
    mean: float | None = in_unit(OF_OUTPUT, "null: too few rows, or the design is no sample.")
    standard_deviation: float | None = in_unit(OF_OUTPUT)
    measures: dict[str, MeasureOfParameters] = Field(
        description="saltelli: first_order and total; morris: mean_magnitude, mean_effect and "
        "spread; latin-hypercube: rank_correlation. Empty where the output does not vary."
    )
    quantiles: Quantiles | None = Field(description="null: the design is no sample.")
    failure: Failure | None = Field(description="null: no limit was given, or it is no sample.")
