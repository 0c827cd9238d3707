"""Channels over time, one panel each; also the scene's declared outputs, as the paper has them."""

import numpy as np

from jointplay.figures import colours, page, sampling, scene_facts
from jointplay.figures.kind import NotDrawable, RunFigure, Selection, at_most
from jointplay.figures.quantity import scale
from jointplay.figures.time_axis import TimeAxis
from jointplay.records.arrays import Floats
from jointplay.records.run import Source

MOST_PANELS = 8
_PANEL_HEIGHT = 30.0  # mm
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


def _draw(source: Source, selection: Selection) -> page.Figure:
    """Draw channels below one another over the same time, with extremes that samples miss."""
    names = declared(source, selection)
    named = [sampling.named_over_time(source, name, selection) for name in names]
    curves = [(time, values) for time, values, _ in named]
    missed = [
        _missed_extremes(source, name, curve) for name, curve in zip(names, curves, strict=True)
    ]
    across = TimeAxis(source, [time for time, _ in curves])
    explained = bool(across.unconverged) or any(len(time) for time, _ in missed)
    figure, panels = page.stack([_PANEL_HEIGHT] * len(names), explained)
    for axes, name, (time, values, label), (when, extremes) in zip(
        panels, names, named, missed, strict=True
    ):
        shown = scale(scene_facts.channel(source, name).unit, values, extremes)
        axes.plot(
            across.shown(time),
            values / shown.factor,
            color=colours.COMPUTED,
            label=label,
        )
        style: page.Style = {
            "color": colours.MARKED,
            "label": "extreme between samples",
        } | page.RING
        axes.plot(across.shown(when), extremes / shown.factor, "o", **style)
        across.shade(axes)
        axes.set_ylabel(page.in_lines(shown.label(name)))
    page.finish_stack(figure, panels, across.label, panels[0] if explained else None)
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
    draw=_draw,
)

OUTPUTS = RunFigure(
    name="outputs",
    title="The scene's declared outputs over time",
    uses=("channels", "start", "stop"),
    channels=declared,
    draw=_draw,
)
