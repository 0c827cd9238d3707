"""A selection from what somebody typed: channels by glob, and a window of time or of points."""

from collections.abc import Sequence

from jointplay.figures.errors import NotDrawable
from jointplay.figures.kind import Selection, is_study
from jointplay.records.channel_choice import choose
from jointplay.records.run import Source
from jointplay.records.study import StudySource


def select(
    source: Source | StudySource,
    channels: Sequence[str] = (),
    joints: Sequence[str] = (),
    start: float | None = None,
    stop: float | None = None,
) -> Selection:
    """Return what to draw of a run or a study.

    Parameters
    ----------
    source
        The results.
    channels
        Names or globs; all that the figure is about if empty.
    joints
        Names of clearance joints.
    start, stop
        Window of time [s]; of a study the first point, and the one before which to end.

    Raises
    ------
    NoSuchChannel
        A name or glob matches nothing.
    NotDrawable
        There is no such point.
    """
    if not is_study(source):
        known = [channel.name for channel in source.channels]
        return Selection(_chosen(channels, known), tuple(joints), start=start, stop=stop)
    known = [channel.name for channel in (*source.observables, *source.channels)]
    first, end = _point("start", start), _point("stop", stop)
    if not range(source.points)[slice(first, end)]:
        line = f"There is no such point; the study has points 0 to {source.points - 1}."
        raise NotDrawable(line, "start")
    return Selection(
        _chosen(channels, known),
        tuple(joints),
        first=first,
        last=None if end is None else min(end, source.points) - 1,
    )


def _chosen(channels: Sequence[str], known: Sequence[str]) -> tuple[str, ...]:
    return tuple(choose(",".join(channels), known)) if channels else ()


def _point(name: str, value: float | None) -> int | None:
    if value is None:
        return None
    if value < 0 or value != int(value):
        raise NotDrawable(f"{name} is {value:g}; points of a study are counted from 0.", name)
    return int(value)
