"""Results as the API shows them. Where nothing was computed a value is null."""

from typing import Any, Self, cast

from pydantic import BaseModel, Field

from jointplay.records.channel import Channel
from jointplay.records.impact import MEASURED
from jointplay.records.resolution import Basis
from jointplay.service.fields import in_unit

Values = list[float | None]


class Partial(BaseModel):
    """Results that can be read before they are complete."""

    complete: bool = Field(
        description="False: the job runs, or failed or was cancelled on the way."
    )


class Described(BaseModel):
    """A quantity that was stored."""

    unit: str
    long_name: str = Field(description="What the quantity is, in words.")

    @classmethod
    def of(cls, channel: Channel, **columns: Any) -> Self:
        """Show columns of a quantity, arrays or what `as_json` takes for them."""
        shown = cls.model_construct(unit=channel.unit, long_name=channel.long_name, **columns)
        return cast("Self", shown)


class Series(Described):
    """Values of one quantity, one for each row."""

    values: Values


_NOTE = Field(default="", description="What is to be known of these numbers; mostly empty.")


class Resolution(BaseModel):
    """Basis from which the numbers of a window were computed."""

    basis: Basis = Field(
        description="steps: those of the run, so that no peak is lost; motion: the same, of an"
        " ideal mechanism; intervals: extremes of the trajectory from each sample to the next;"
        " samples: what the samples show."
    )
    spacing: float | None = in_unit(
        "s", "From a sample to the next, where the basis is intervals or samples.", default=None
    )
    since: float | None = in_unit(
        "s", "From when on extremes are of intervals; before, they are of steps.", default=None
    )


_RESOLUTION = Field(default=None, description="What the numbers were computed from.")


class History(Partial):
    """Channels on the output grid, or every so many seconds."""

    time: Series
    channels: dict[str, Series]
    note: str = _NOTE
    resolution: Resolution | None = _RESOLUTION


class Bins(BaseModel):
    """Begin and end of consecutive spans of time, or first and last samples of groups of them."""

    unit: str
    first: Values = Field(description="Where each span begins, or the first sample of each group.")
    last: Values = Field(description="Where each span ends, or the last sample of each group.")


class Extremes(Described):
    """Smallest and largest value of one quantity in each span of time, or group of samples."""

    minimum: Values
    maximum: Values


class Overview(Partial):
    """Channels at the resolution of a screen: no peak is lost."""

    samples: int = Field(description="Samples in the window.")
    bins: Bins
    extremes: dict[str, Extremes]
    exact: bool = Field(
        default=False,
        description="Whether these are extremes of the trajectory, and not only of samples.",
    )
    note: str = _NOTE
    resolution: Resolution | None = _RESOLUTION


class Poincare(History):
    """Channels at the Poincare sections."""

    note: str = Field(description="Why there are no sections; else empty.")


class Peak(BaseModel):
    """Signed extremes of one channel over a window, or the run, found between the samples too."""

    unit: str
    minimum: float | None
    minimum_time: float | None = in_unit("s")
    maximum: float | None
    maximum_time: float | None = in_unit("s")


class Peaks(Partial):
    """Extremes by channel."""

    peaks: dict[str, Peak]


class Impact(BaseModel):
    """One contact in a clearance joint, from onset to release."""

    joint: str
    onset: float | None = in_unit(*MEASURED["onset"])
    release: float | None = in_unit("s", "time of release; null: still in contact at the end")
    approach_rate: float | None = in_unit(*MEASURED["approach_rate"])
    peak_force: float | None = in_unit(*MEASURED["peak_force"])
    impulse: float | None = in_unit(*MEASURED["impulse"])


class Impacts(Partial):
    """Contacts in order of release."""

    impacts: list[Impact]


class EnergyLedger(BaseModel):
    """Energy that the mechanism took in and gave off, integrated along with the motion."""

    driver_work: float = in_unit("J", "Work of the drivers.")
    gravity_work: float = in_unit("J", "Work of gravity.")
    contact_loss: float = in_unit("J", "Lost to the damping of contacts.")
    friction_loss: float = in_unit("J", "Lost to friction.")
    element_loss: float = in_unit("J", "Lost in force elements.")
    kinetic_change: float = in_unit("J", "Kinetic energy at the end less that at the start.")
    stored_change: float = in_unit("J", "Elastic energy of contacts at the end less at the start.")
    gross_work: float = in_unit(
        "J", "Works of drivers, gravity, contacts and friction, summed without their signs."
    )
    residual: float = in_unit("J", "What remains of the balance: the ledger's error.")


class Statistics(Partial):
    """Cost of a run, and its energy ledger; null where there is none."""

    method: str | None = Field(default=None, description="The integration method that ran.")
    method_reason: str | None = Field(
        default=None, description="Why: asked for, not stiff, stiff, or as the tolerance wants it."
    )
    steps: int | None = Field(default=None, description="Accepted steps of the integrator.")
    rejections: int | None = Field(default=None, description="Steps that were tried again.")
    onsets: int | None = Field(default=None, description="Contacts that began.")
    slow_impacts: int | None = Field(
        default=None,
        description="Those slower than the floor that their law divides by.",
    )
    rough_steps: int | None = Field(
        default=None,
        description="Steps in which a channel left its values at both ends by more than 0.003 of"
        " its range, of those that were looked at for this. Where there are many, extremes between"
        " the ends of others may be missed.",
    )
    smallest_step: float | None = in_unit("s", default=None)
    solver_seconds: float | None = in_unit("s", "Processor time of the solver.", default=None)
    energy: EnergyLedger | None = Field(
        default=None, description="Null for a run without freedom: nothing is integrated there."
    )
    notes: list[str] = Field(
        default=[], description="What the scene gives and the run does not keep, with both values."
    )


class FigureLink(BaseModel):
    """One figure of a job."""

    name: str
    title: str
    png: str = Field(description="Address of the figure as PNG.")
    svg: str = Field(description="Address of the figure as SVG.")
    pdf: str = Field(description="Address of the figure as PDF.")
    eps: str = Field(description="Address of the figure as EPS.")


class Figures(BaseModel):
    """The figures that can be drawn of a job's results."""

    figures: list[FigureLink]
