"""A member of the family of figures, the selection of what it shows, and its errors."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Generic, TypeVar

from jointplay.figures import page
from jointplay.records.channel_choice import choose
from jointplay.records.extremes import extremes
from jointplay.records.motion import LABELS
from jointplay.records.run import Source
from jointplay.records.study import StudySource
from jointplay.records.suggestions import did_you_mean
from jointplay.records.window_query import wrong_end

if TYPE_CHECKING:
    from typing_extensions import TypeIs

Results = TypeVar("Results", Source, StudySource)


class FigureError(Exception):
    """Base of every error of this package; its text is a full sentence."""


class UnknownFigure(FigureError):
    """There is no figure of that name."""

    def __init__(self, name: str, known: Sequence[str], channels: Sequence[str]) -> None:
        meant = did_you_mean(name, [*known, *channels])
        super().__init__(
            f"There is no figure {name!r} of these results; {meant}{' ' if meant else ''}there are "
            f"{', '.join((*known, 'every stored channel'))}."
        )


class NotDrawable(FigureError):
    """These results, or this selection, do not hold what the figure needs.

    Attributes
    ----------
    cause : str
        What to change: ``name`` of the figure, or of the selection ``channels``, ``joints``,
        ``start``, ``stop`` or ``over``.
    """

    def __init__(self, sentence: str, cause: str = "name") -> None:
        super().__init__(sentence)
        self.cause = cause


def at_most(most: int, names: Sequence[str], kind: str = "channels") -> tuple[str, ...]:
    """Return the channels, or joints, of a figure's panels; `NotDrawable` if too many."""
    if len(names) > most:
        sentence = f"One figure shows at most {most} {kind}, not {len(names)}; choose fewer."
        raise NotDrawable(sentence, kind)
    return tuple(names)


@dataclass(frozen=True)
class Selection:
    """Part of the results to draw; by default all that the figure is about.

    Parameters
    ----------
    channels
        Names of channels, where a figure lets one choose.
    joints
        Names of clearance joints, where a figure draws one panel a joint.
    start, stop
        Window of time [s], both ends included; of a study the first point, and the one before
        which to end.
    over
        Results of another study, which lie beneath.
    """

    channels: tuple[str, ...] = ()
    joints: tuple[str, ...] = ()
    start: float | None = None
    stop: float | None = None
    over: StudySource | None = None

    def given(self) -> list[str]:
        """Name what was chosen."""
        return [one.name for one in fields(self) if getattr(self, one.name) not in ((), None)]


@dataclass(frozen=True)
class FigureKind(Generic[Results]):
    """One figure of a registry.

    Parameters
    ----------
    name
        As it is asked for.
    title
        What it shows, for lists.
    uses
        Fields of the selection that mean something for it.
    channels
        Channels whose values it reads; raises `NotDrawable` where the source or the selection
        does not have what it needs.
    draw
        Draws it; only called with what `channels` accepted, inside `page.style`.
    """

    name: str
    title: str
    uses: tuple[str, ...]
    channels: Callable[[Results, Selection], tuple[str, ...]]
    draw: Callable[[Results, Selection], page.Figure]

    def check(self, selection: Selection) -> None:
        """Refuse what cannot be chosen here, with `NotDrawable`."""
        for name in selection.given():
            if name not in self.uses:
                raise NotDrawable(
                    f"The figure {self.name!r} does not depend on {name}; leave it out.", name
                )


RunFigure = FigureKind[Source]
StudyFigure = FigureKind[StudySource]


def is_study(source: Source | StudySource) -> "TypeIs[StudySource]":
    """Tell whether results are those of a study, and not of one run."""
    return hasattr(source, "observables")


def select(
    source: Source | StudySource,
    channels: Sequence[str] = (),
    joints: Sequence[str] = (),
    start: float | None = None,
    stop: float | None = None,
    over: StudySource | None = None,
) -> Selection:
    """Return what to draw of a run or a study.

    Parameters
    ----------
    source
        The results.
    channels
        Names or globs, drawn in this order; all that the figure is about if empty.
    joints, start, stop, over
        As in `Selection`.

    Raises
    ------
    NoSuchChannel
        A name or glob matches nothing.
    NotDrawable
        The window ends before it begins, or an end is no number.
    """
    if (wrong := wrong_end(start, stop, "")) is not None:
        end, sentence = wrong
        raise NotDrawable(sentence, end)
    chosen = choose(",".join(channels), _names(source)) if channels else ()
    return Selection(tuple(chosen), tuple(joints), start, stop, over)


def _names(source: Source | StudySource) -> list[str]:
    """Return what a figure may be asked for: of a study what its points have besides, too."""
    if not is_study(source):
        return [channel.name for channel in source.channels]
    names = [channel.name for channel in (*source.observables, *source.channels)]
    numbers = [*source.indicators, *source.statistics]
    on_maps = [*extremes(source), *LABELS] if len(source.shape) == 2 else LABELS
    return [*names, *numbers, *on_maps]
