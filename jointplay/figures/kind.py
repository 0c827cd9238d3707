"""What every figure of the family provides."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from jointplay.source import Source

if TYPE_CHECKING:
    from matplotlib.figure import Figure


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
    """

    channels: tuple[str, ...] = ()
    joints: tuple[str, ...] = ()
    start: float | None = None
    stop: float | None = None


@dataclass(frozen=True)
class FigureKind:
    """One figure of the roster.

    Parameters
    ----------
    name
        As it is asked for.
    title
        What it shows, for lists.
    channels
        Channels whose values it reads; raises `NotDrawable` where the source or the selection
        does not have what it needs.
    draw
        Draws it; only called with what `channels` accepted, inside `page.style`.
    """

    name: str
    title: str
    channels: Callable[[Source, Selection], tuple[str, ...]]
    draw: Callable[[Source, Selection], Figure]
