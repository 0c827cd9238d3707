"""A run's certificate as the API shows it. Null stands where nothing is known or claimed."""

from typing import Any

from pydantic import BaseModel, Field

from jointplay.service.results.schemas import Series, Values

Span = tuple[float, float]


def _in(unit: str, description: str, **more: Any) -> Any:  # what pydantic's Field returns
    return Field(description=description, json_schema_extra={"unit": unit}, **more)


class Exponent(BaseModel):
    """How fast small deviations grew: a finite-time Lyapunov exponent over windows of the run."""

    value: float = _in("1/s", "Mean over the windows.")
    error: float | None = _in("1/s", "Standard error of the mean; null of one window.")
    lowest: float = _in("1/s", "Of the windows.")
    highest: float = _in("1/s", "Of the windows.")
    windows: int
    time: float = _in("s", "Of all windows together.")


class Violation(BaseModel):
    """How far the constraints of joints and drivers were violated at most, at the samples."""

    position: float = _in("m", "Of positions.")
    angle: float = _in("rad", "Of angles.")
    note: str


class Lane(BaseModel):
    """The trajectory (first) or a companion."""

    tolerance: float
    perturbed: bool = Field(description="It starts a little beside the scene's start.")
    time: float = _in("s", "Simulated time reached.")
    complete: bool
    steps: int
    rejections: int
    onsets: int
    smallest_step: float | None = _in("s", "Smallest accepted step.")
    energy_residual: float | None = _in("J", "What its energy ledger lacks.")


class ChannelExtremes(BaseModel):
    """Extremes over several lanes, in the channel's unit."""

    lowest_minimum: float | None
    highest_minimum: float | None
    lowest_maximum: float | None
    highest_maximum: float | None


class Histogram(BaseModel):
    """Shares of time in bins of equal width, over companions."""

    edges: Values = Field(description="Of the bins, in the channel's unit.")
    share: Values = Field(description="Mean share of time in each bin.")
    spread: Values = Field(description="Its standard deviation over companions.")


class ChannelCertificate(BaseModel):
    """How far one channel can be believed."""

    unit: str
    long_name: str
    until: float | None = _in("s", "Until when its error stays below a small share of its scale.")
    error: Values = Field(description="Estimated error at each time, in the channel's unit.")
    extremes: ChannelExtremes
    histogram: Histogram


class Certificate(BaseModel):
    """How far a run can be believed."""

    complete: bool
    note: str
    horizon: float | None = _in("s", "Until when the trajectory itself is converged.")
    converged: list[Span] = _in("s", "Spans in which it is; the first ends at the horizon.")
    criterion: str = Field(default="", description="What converged means.")
    safety: float | None = Field(default=None, description="Factor in the estimated errors.")
    exponent: Exponent | None = None
    exponent_note: str = Field(default="", description="Why there is no exponent.")
    energy_residual: float | None = _in("J", "What the energy ledger lacks.", default=None)
    gross_work: float | None = _in("J", "All works without their signs.", default=None)
    energy_error: float | None = Field(default=None, description="Residual by gross work.")
    constraint_violation: Violation | None = None
    lanes: list[Lane] = []
    lanes_with_extremes: list[int] = Field(default=[], description="Lanes that sought extremes.")
    steps: int | None
    rejections: int | None
    onsets: int | None = Field(description="Contacts that began.")
    smallest_step: float | None = _in("s", "Smallest accepted step.")
    solver_seconds: float | None = _in("s", "Processor time, companions included.")
    time: Series
    channels: dict[str, ChannelCertificate]
