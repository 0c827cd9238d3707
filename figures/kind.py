"""What every figure of the family provides."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Generic, TypeVar

from jointplay.figures.errors import NotDrawable
from jointplay.records.run import Source
from jointplay.records.study import StudySource

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from typing_extensions import TypeIs

Results = TypeVar("Results", Source, StudySource)


@dataclass(frozen=True)
class Selection:
    """What of the results to draw; nothing given means all that the figure is about.

    Parameters
    ----------
    channels
        Names of channels, where a figure lets one choose.
    joints
        Names of clearance joints, where a figure draws one panel a joint.
    start, stop
        Window of time [s], both ends included.
    first, last
        Points of a study, both ends included.
    """

    channels: tuple[str, ...] = ()
    joints: tuple[str, ...] = ()
    start: float | None = None
    stop: float | None = None
    first: int | None = None
    last: int | None = None

    def given(self) -> list[str]:
        """Name what was chosen."""
        return [one.name for one in fields(self) if getattr(self, one.name) not in ((), None)]


@dataclass(frozen=True)
class FigureKind(Generic[Results]):
    """One figure of a roster.

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
    draw: Callable[[Results, Selection], Figure]

    def check(self, selection: Selection) -> None:
        """Refuse what cannot be chosen here, with `NotDrawable`."""
        for name in selection.given():
            if name not in self.uses:
                raise NotDrawable(
                    f"The figure {self.name!r} does not depend on {name}; leave it out.", name
                )


RunFigure = FigureKind[Source]
StudyFigure = FigureKind[StudySource]


def is_study(source: Source | StudySource) -> TypeIs[StudySource]:
    """Tell whether results are those of a study, and not of one run."""
    return hasattr(source, "observables")
