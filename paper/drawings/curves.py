"""Curves of the figures of a sweep: the runs that are compared, their colours, their curves."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Final

from jointplay.figures import page, sampling
from jointplay.figures.kind import Selection
from jointplay.storage.results import ResultReader

if TYPE_CHECKING:
    from matplotlib.axes import Axes

FIRST: Final = 0.4
"""s: in which the publication sees the motion settle from its start."""
COLOURS: Final = (page.GREEN, page.BLUE, page.VERMILION)


@dataclass(frozen=True)
class Compared:
    """A run, its name in the legend, and its colour."""

    store: Path
    label: str
    colour: str


def over_time(
    axes: Axes, one: Compared, channel: str, factor: float, width: float, stop: float | None = None
) -> None:
    """Draw a channel over time [s] up to `stop`, in units of `factor`, all extremes included."""
    time, values = sampling.over_time(ResultReader(one.store), channel, Selection(stop=stop))
    axes.plot(time, values / factor, color=one.colour, linewidth=width, label=one.label)


def true_peak(
    axes: Axes, one: Compared, channel: str, factor: float, stop: float | None = None
) -> None:
    """Circle the extreme of the larger magnitude that the solver found, unless it is later."""
    peak = ResultReader(one.store).peaks()[channel]
    low, high = (peak.minimum_time, peak.minimum), (peak.maximum_time, peak.maximum)
    time, value = max(low, high, key=lambda found: abs(found[1]))
    if stop is not None and time > stop:
        return
    axes.plot(
        [time],
        [value / factor],
        "o",
        color=one.colour,
        markerfacecolor="none",
        markersize=3.5,
        markeredgewidth=0.7,
    )
