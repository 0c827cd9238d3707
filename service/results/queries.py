"""Queries of results: channels and a window of time, within bounds."""

from collections.abc import Iterable

from pydantic import BaseModel, ConfigDict, Field

from jointplay.records.channel import Channel
from jointplay.records.channel_choice import NoSuchChannel, choose
from jointplay.service.fields import in_unit
from jointplay.service.problems import ErrorDetail, RequestRefused, kinds

MOST_POINTS = 100_000  # of an overview: more than any screen is wide
MOST_VALUES = 1_000_000  # in one answer: about 20 MB of JSON


class Window(BaseModel):
    """A window of time, both ends included."""

    model_config = ConfigDict(extra="forbid", allow_inf_nan=False, frozen=True)

    start: float | None = in_unit("s", "From this time on.", default=None)
    stop: float | None = in_unit("s", "Up to this time.", default=None)

    def checked(self) -> tuple[float | None, float | None]:
        """Return start and stop, or refuse a window that ends before it begins."""
        if self.start is not None and self.stop is not None and self.start > self.stop:
            sentence = f"stop ({self.stop:g} s) is before start ({self.start:g} s); swap them."
            raise RequestRefused.of_parameter("stop", sentence)
        return self.start, self.stop


class ChannelsQuery(BaseModel):
    """Channels."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    channels: str | None = Field(
        default=None,
        max_length=20_000,
        description="Names or globs, separated by commas, such as `slider7.*,A.normal_force`; "
        "default: all that the job stored.",
    )


class Selection(ChannelsQuery, Window):
    """Channels and a window of time."""


class TimeOrPoints(Selection):
    """Channels, and a part of the results: of a simulation by time, of a study by points."""

    start: float | None = Field(
        default=None,
        description="Of a simulation: from this time on, in s. Of a study: first point.",
    )
    stop: float | None = Field(
        default=None,
        description="Of a simulation: up to this time, in s. Of a study: point before which to "
        "end.",
    )


class HistoryQuery(Selection):
    """Channels, a window of time, and how finely it is shown."""

    points: int | None = Field(
        default=None,
        ge=1,
        le=MOST_POINTS,
        description="Pairs of smallest and largest values to show, such as pixels of a screen. "
        "Default: every sample.",
    )
    step: float | None = in_unit(
        "s", "Time between instants to compute channels at, however close.", default=None, gt=0.0
    )


def chosen_channels(
    text: str | None, described: Iterable[Channel], parameter: str = "channels"
) -> list[str]:
    """Return the channels that a comma-separated list of names and globs means, or refuse."""
    try:
        return choose(text, [channel.name for channel in described])
    except NoSuchChannel as error:
        raise unknown_channels(error, parameter) from None


def unknown_channels(error: NoSuchChannel, parameter: str = "channels") -> RequestRefused:
    """Return the refusal of names or globs that match nothing."""
    errors = [ErrorDetail(parameter=parameter, detail=one) for one in error.sentences]
    return RequestRefused(kinds.UNKNOWN_CHANNEL, errors[0].detail, errors)


def check_size(
    rows: int, columns: int, what: str, seconds: float, *, of_channels: bool = True
) -> None:
    """Refuse an answer of more than `MOST_VALUES` values, and say how to narrow the question.

    Parameters
    ----------
    rows, columns
        Samples of the window, and channels with the time.
    what
        Name of the rows, in the plural.
    seconds
        Length of the window, s.
    of_channels
        Whether the columns can be chosen.
    """
    if rows * columns <= MOST_VALUES:
        return
    rows_allowed = MOST_VALUES // columns
    numbers = f"{columns - 1} channels and the time" if of_channels else f"{columns} values each"
    fewer = "fewer channels with `channels`, or for " if of_channels else ""
    sentence = (
        f"{rows} {what} of {numbers} are {rows * columns} values; one "
        f"answer carries at most {MOST_VALUES}. Ask for {fewer}"
        f"windows of {rows_allowed} {what} (about {seconds * rows_allowed / rows:.3g} s) with "
        "`start` and `stop`."
    )
    raise RequestRefused.of_parameter(
        "stop", sentence, kinds.RESPONSE_TOO_LARGE, remedy="Choose a shorter window."
    )


def check_step(step: float, seconds: float, channels: int) -> None:
    """Refuse instants every `step` s of a window of `seconds` that are too many values."""
    most = MOST_VALUES // (channels + 1)
    if seconds < (1.0 - 1e-12) * most * step:
        return
    least = f"{1.01 * seconds / most:.3g}"  # more than is needed, also when it is rounded
    sentence = (
        f"Of {channels} channels and the time one answer carries at most {most} instants. Every "
        f"{step:g} s there are more in {seconds:.3g} s; ask for a `step` of at least {least} s, "
        "for fewer channels with `channels`, or for a shorter window with `start` and `stop`."
    )
    raise RequestRefused.of_parameter(
        "step", sentence, kinds.RESPONSE_TOO_LARGE, remedy=f"Ask for at least {least} s."
    )


def check_points(points: int, channels: int) -> None:
    """Refuse an overview of more than `MOST_VALUES` values."""
    most = MOST_VALUES // (2 * (channels + 1))
    if points <= most:
        return
    sentence = (
        f"{points} pairs of {channels} channels are more than the {MOST_VALUES} values that one "
        f"answer carries; of these channels it carries {most} points."
    )
    raise RequestRefused.of_parameter(
        "points", sentence, kinds.RESPONSE_TOO_LARGE, remedy=f"Ask for at most {most} points."
    )
