"""Channels over time, one panel each; also the scene's declared outputs, as the paper has them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from jointplay.figures import horizon, page, sampling, scene_facts
from jointplay.figures.errors import NotDrawable, at_most
from jointplay.figures.kind import RunFigure, Selection
from jointplay.figures.quantity import scale
from jointplay.records.run import Floats, Source

if TYPE_CHECKING:
    from matplotlib.figure import Figure

MOST_PANELS = 8
_PANEL_HEIGHT = 30.0  # mm
_AXIS_HEIGHT = 8.0
_NOTICEABLE = 0.01
"""An extreme is marked if it lies beyond the samples by this share of the range."""


def _chosen(source: Source, selection: Selection) -> tuple[str, ...]:
    if not selection.channels:
        raise NotDrawable("Say which channels to draw over time.", "channels")
    return scene_facts.stored(source, at_most(MOST_PANELS, selection.channels))


def declared(source: Source, selection: Selection) -> tuple[str, ...]:
    """Name the chosen channels, by default the declared outputs; `NotDrawable` without any."""
    names = selection.channels or scene_facts.outputs(source)[:MOST_PANELS]
    if not names:
        raise NotDrawable("The scene declares no outputs, or the job did not store them.")
    return scene_facts.stored(source, names)


def panels_over_time(source: Source, names: tuple[str, ...], selection: Selection) -> Figure:
    """Draw channels below one another over the same time, with extremes that samples miss."""
    curves = [sampling.over_time(source, name, selection) for name in names]
    missed = [
        _missed_extremes(source, name, curve) for name, curve in zip(names, curves, strict=True)
    ]
    time = curves[0][0]
    spans = horizon.gaps(source, float(time[0]), float(time[-1]))
    explained = spans or any(len(time) for time, _ in missed)
    legend_height = page.LEGEND_HEIGHT if explained else 0.0
    height = _PANEL_HEIGHT * len(names) + _AXIS_HEIGHT + legend_height
    figure, grid = page.panels(len(names), 1, height, share_x=True)
    seconds = scale("s", *(time for time, _ in curves))
    for (axes,), name, (time, values), (when, extremes) in zip(
        grid, names, curves, missed, strict=True
    ):
        shown = scale(scene_facts.channel(source, name).unit, values, extremes)
        axes.plot(time / seconds.factor, values / shown.factor, color=page.BLUE, label="samples")
        axes.plot(
            when / seconds.factor,
            extremes / shown.factor,
            "o",
            color=page.VERMILION,
            markerfacecolor="none",
            markeredgewidth=0.7,
            label="extreme between samples",
        )
        horizon.shade(axes, spans, seconds.factor)
        axes.set_ylabel(shown.label(name))
    grid[-1][0].set_xlabel(seconds.label("time"))
    figure.align_ylabels()
    if legend_height:
        page.legend(figure, grid[0][0])
    return figure


def _missed_extremes(
    source: Source, name: str, curve: tuple[Floats, Floats]
) -> tuple[Floats, Floats]:
    """Give time [s] and value of the run's extremes inside the window that no sample comes near."""
    peak = source.peaks().get(name)
    time, values = curve
    if peak is None or not np.isfinite(values).any():
        return np.empty(0), np.empty(0)
    low, high = float(np.nanmin(values)), float(np.nanmax(values))
    margin = _NOTICEABLE * max(high - low, peak.maximum - peak.minimum)
    found = [
        (when, value)
        for when, value, beyond in (
            (peak.minimum_time, peak.minimum, low - peak.minimum),
            (peak.maximum_time, peak.maximum, peak.maximum - high),
        )
        if beyond > margin and time[0] <= when <= time[-1]
    ]
    points = np.array(found, dtype=np.float64).reshape(-1, 2)
    return points[:, 0], points[:, 1]


TIME_HISTORY = RunFigure(
    name="time-history",
    title="Chosen channels over time",
    uses=("channels", "start", "stop"),
    channels=_chosen,
    draw=lambda source, selection: panels_over_time(source, _chosen(source, selection), selection),
)

OUTPUTS = RunFigure(
    name="outputs",
    title="The scene's declared outputs over time",
    uses=("channels", "start", "stop"),
    channels=declared,
    draw=lambda source, selection: panels_over_time(source, declared(source, selection), selection),
)
