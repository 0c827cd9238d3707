"""A run's certificate as the API shows it. Null stands where nothing is known or claimed."""

from pydantic import BaseModel, Field

from jointplay.service.fields import in_unit
from jointplay.service.results.schemas import Described, Partial, Series, Values

Span = tuple[float, float]


class Exponent(BaseModel):
    """Growth of small deviations: a finite-time Lyapunov exponent over windows of the run."""

    value: float = in_unit("1/s", "Mean over the windows.")
    error: float | None = in_unit("1/s", "Standard error of the mean; null of one window.")
    lowest: float = in_unit("1/s", "Of the windows.")
    highest: float = in_unit("1/s", "Of the windows.")
    windows: int
    time: float = in_unit("s", "Of all windows together.")


class CertifiedImpacts(BaseModel):
    """Span in which the list of impacts is that of the motion, not of the steps."""

    until: float = in_unit("s", "Until when number and order of contacts are certified.")
    certified: int = Field(description="Contacts that began by then.")
    count: int = Field(description="Contacts that began in the whole run.")
    onset_error: float | None = in_unit(
        "s", "Largest estimated error of a certified onset; null without any."
    )


class Violation(BaseModel):
    """Largest violation of the constraints of joints and drivers, at the samples."""

    position: float = in_unit("m", "Of positions.")
    angle: float = in_unit("rad", "Of angles.")
    note: str


class Lane(BaseModel):
    """The trajectory (first) or a companion."""

    tolerance: float
    perturbed: bool = Field(description="It starts a little beside the scene's start.")
    time: float = in_unit("s", "Simulated time reached.")
    complete: bool
    steps: int
    rejections: int
    onsets: int
    smallest_step: float | None = in_unit("s", "Smallest accepted step.")
    energy_residual: float | None = in_unit("J", "What its energy ledger lacks.")


class PullingFollower(BaseModel):
    """An ideal follower that is pulled."""

    joint: str
    first: float = in_unit("s", "When it is pulled first, to a sample.")
    largest: float = in_unit("N", "Largest pull.")
    time: float = in_unit("s", "When that is.")
    detail: str


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


class ChannelCertificate(Described):
    """Estimated errors and extremes of one channel."""

    until: float | None = in_unit(
        "s", "Until when its error stays below a small share of its scale."
    )
    bar: str | None = Field(description="Kind of its estimated error, one of `bars`.")
    error: Values = Field(description="Estimated error at each time, in the channel's unit.")
    extremes: ChannelExtremes
    histogram: Histogram


class Certificate(Partial):
    """Estimated errors of a run, and for how long they are known."""

    note: str
    horizon: float | None = in_unit("s", "Until when the trajectory itself is converged.")
    forces_until: float | None = in_unit(
        "s", "Until when all forces and accelerations have a small error.", default=None
    )
    converged: list[Span] = in_unit("s", "Spans in which it is; the first ends at the horizon.")
    criterion: str = Field(default="", description="What converged means.")
    impacts: CertifiedImpacts | None = Field(
        default=None, description="How long the list of impacts is known; null: nothing touches."
    )
    safety: float | None = Field(default=None, description="Factor in the estimated errors.")
    bars: dict[str, str] = Field(
        default={},
        description="What estimated errors of each kind are made of, and where they hold.",
    )
    exponent: Exponent | None = None
    exponent_note: str = Field(
        default="", description="Why there is no exponent, or what its error counts."
    )
    slow_impacts: int = Field(
        default=0, description="Impacts slower than the floor that their law divides by."
    )
    pulling: list[PullingFollower] = Field(
        default=[], description="Ideal followers that their cams pull: with play they lift off."
    )
    energy_residual: float | None = in_unit("J", "What the energy ledger lacks.", default=None)
    gross_work: float | None = in_unit("J", "All works without their signs.", default=None)
    energy_error: float | None = Field(default=None, description="Residual by gross work.")
    energy_in_tolerances: float | None = Field(
        default=None,
        description="The same by the tolerance: most runs have less than 10; null: fixed steps, or"
        " rounding alone.",
    )
    constraint_violation: Violation | None = None
    lanes: list[Lane] = []
    lanes_with_extremes: list[int] = Field(default=[], description="Lanes that sought extremes.")
    steps: int | None
    rejections: int | None
    onsets: int | None = Field(description="Contacts that began.")
    smallest_step: float | None = in_unit("s", "Smallest accepted step.")
    solver_seconds: float | None = in_unit("s", "Processor time, companions included.")
    time: Series
    channels: dict[str, ChannelCertificate]
