"""Queries of a study: a range of points and of their sections, within bounds."""

from collections.abc import Sequence

from pydantic import BaseModel, ConfigDict, Field

from jointplay.records.channel import Channel, by_name
from jointplay.service.problems import RequestRefused, kinds
from jointplay.service.results.queries import MOST_VALUES, TimeOrPoints, chosen_channels
from jointplay.storage.studies.reader import StudyReader


def chosen(text: str | None, described: Sequence[Channel], parameter: str) -> tuple[Channel, ...]:
    """Return the channels that a list of names and globs means, all without one, or refuse."""
    known = by_name(described)
    return tuple(known[name] for name in chosen_channels(text, described, parameter))


class PointRange(BaseModel):
    """A range of points."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    start: int | None = Field(default=None, ge=0, description="First point; default 0.")
    stop: int | None = Field(
        default=None, ge=0, description="Point before which to end; default: after the last."
    )

    def points(self, store: StudyReader) -> range:
        """Return the points that were asked for, or refuse a range outside the study."""
        return _within(store.points, "point", self.start, self.stop, ("start", "stop"))


class SectionRange(PointRange):
    """A range of points and, of each, a range of sections."""

    section_start: int | None = Field(
        default=None, ge=0, description="First section of each point; default 0."
    )
    section_stop: int | None = Field(
        default=None, ge=0, description="Section before which to end; default: after the last."
    )

    def sections(self, store: StudyReader) -> range:
        """Return the sections of each point that were asked for, or refuse others."""
        names = ("section_start", "section_stop")
        return _within(store.record, "section", self.section_start, self.section_stop, names)


class BifurcationQuery(SectionRange):
    """One observable at the sections of a range of points."""

    observable: str | None = Field(
        default=None,
        max_length=200,
        description="Channel that was taken at the sections; default: the first one.",
    )

    def taken(self, store: StudyReader) -> Channel:
        """Return the observable that is meant, or refuse one that was not recorded."""
        if self.observable is None:
            return store.observables[0]
        described = by_name(store.observables)
        if self.observable in described:
            return described[self.observable]
        return chosen(self.observable, store.observables, "observable")[0]


class BranchQuery(BaseModel):
    """Columns of branches."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    columns: str | None = Field(
        default=None,
        max_length=20_000,
        description="Names or globs of columns, separated by commas; default: all.",
    )

    def taken(self, store: StudyReader) -> tuple[Channel, ...]:
        """Return the columns that are meant, or refuse others."""
        return chosen(self.columns, store.observables, "columns")


class SweepQuery(PointRange):
    """Extremes of channels at a range of points."""

    channel: str | None = Field(
        default=None,
        max_length=20_000,
        description="Names or globs of channels, separated by commas; default: all.",
    )

    def of_channels(self, store: StudyReader) -> tuple[Channel, ...]:
        """Return the channels that are meant, or refuse others."""
        return chosen(self.channel, store.channels, "channel")


class PointsQuery(SectionRange):
    """All that is known of a range of points."""

    channels: str | None = Field(
        default=None,
        max_length=20_000,
        description="Names or globs of channels whose extremes to show, separated by commas; "
        "default: all.",
    )
    observables: str | None = Field(
        default=None,
        max_length=20_000,
        description="The same of channels that were taken at the sections; default: none.",
    )

    def of_channels(self, store: StudyReader) -> tuple[Channel, ...]:
        """Return the channels whose extremes are meant, or refuse others."""
        return chosen(self.channels, store.channels, "channels")

    def taken(self, store: StudyReader) -> tuple[Channel, ...]:
        """Return the observables that are meant, or refuse others."""
        if self.observables is None:
            return ()
        return chosen(self.observables, store.observables, "observables")


class PoincareQuery(TimeOrPoints):
    """Selection of Poincare sections: of a simulation by time, of a study by points."""

    section_start: int | None = Field(
        default=None, ge=0, description="Of a study: first section of each point; default 0."
    )
    section_stop: int | None = Field(
        default=None, ge=0, description="Of a study: section before which to end."
    )

    def refuse_sections(self) -> None:
        """Refuse of a simulation what only studies have."""
        for name in ("section_start", "section_stop"):
            if getattr(self, name) is not None:
                raise RequestRefused.of_parameter(
                    name, f"A simulation has no {name}; choose by time, in s."
                )

    def range_of_points(self) -> SectionRange:
        """Return the question to a study, or refuse points that are no whole numbers."""
        return SectionRange(
            start=_whole_point("start", self.start),
            stop=_whole_point("stop", self.stop),
            section_start=self.section_start,
            section_stop=self.section_stop,
        )


def _whole_point(name: str, value: float | None) -> int | None:
    if value is None:
        return None
    if value < 0.0 or not value.is_integer():
        raise RequestRefused.of_parameter(
            name, f"{name} is {value:g}; points of a study are counted from 0."
        )
    return int(value)


def page(points: range, width: int) -> tuple[range, int | None]:
    """Cut a range of points to what one answer carries.

    Parameters
    ----------
    points
        What was asked for.
    width
        Values that each point takes.

    Returns
    -------
    tuple
        The points of this answer, and the `start` of the next one; none if there is none.
    """
    most = MOST_VALUES // width
    if most == 0:
        sentence = (
            f"One point takes {width} values; an answer carries at most {MOST_VALUES}. Ask for a "
            "range of its sections with `section_start` and `section_stop`, or for fewer channels."
        )
        raise RequestRefused.of_parameter(
            "section_stop", sentence, kinds.RESPONSE_TOO_LARGE, remedy="Choose fewer sections."
        )
    if len(points) <= most:
        return points, None
    return points[:most], points[most]


def _within(
    total: int, what: str, start: int | None, stop: int | None, names: tuple[str, str]
) -> range:
    first = 0 if start is None else start
    last = total if stop is None else stop
    if first < last <= total or (first == 0 and last == total):
        return range(first, last)
    wrong = names[0] if first >= total else names[1]
    sentence = (
        f"The study has {what}s 0 to {total - 1}; {names[0]} is the first and {names[1]} the one "
        f"before which to end, so that {names[0]} < {names[1]} <= {total}."
    )
    raise RequestRefused.of_parameter(wrong, sentence)
