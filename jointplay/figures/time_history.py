"""Channels over time, one panel each; also the scene's declared outputs, as the paper has them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from jointplay.figures import page, sampling, scene_facts
from jointplay.figures.errors import NotDrawable
from jointplay.figures.kind import FigureKind, Selection
from jointplay.figures.quantity import scale
from jointplay.source import Source

if TYPE_CHECKING:
    from matplotlib.figure import Figure

MOST_PANELS = 8
_PANEL_HEIGHT = 30.0  # mm
_AXIS_HEIGHT = 8.0


def _chosen(source: Source, selection: Selection) -> tuple[str, ...]:
    if not selection.channels:
        raise NotDrawable("say which channels to draw over time")
    if len(selection.channels) > MOST_PANELS:
        raise NotDrawable(
            f"{len(selection.channels)} channels do not fit one figure; choose at most "
            f"{MOST_PANELS}"
        )
    return scene_facts.stored(source, selection.channels)


def _declared(source: Source, selection: Selection) -> tuple[str, ...]:
    names = selection.channels or scene_facts.outputs(source)[:MOST_PANELS]
    if not names:
        raise NotDrawable("the scene declares no outputs, or the job did not store them")
    return scene_facts.stored(source, names)


def panels_over_time(source: Source, names: tuple[str, ...], selection: Selection) -> Figure:
    """Draw channels below one another over the same time."""
    height = _PANEL_HEIGHT * len(names) + _AXIS_HEIGHT
    figure, grid = page.panels(len(names), 1, height, share_x=True)
    curves = [sampling.over_time(source, name, selection) for name in names]
    seconds = scale("s", *(time for time, _ in curves))
    for (axes,), name, (time, values) in zip(grid, names, curves, strict=True):
        shown = scale(scene_facts.channel(source, name).unit, values)
        axes.plot(time / seconds.factor, values / shown.factor, color=page.BLUE)
        axes.set_ylabel(shown.label(name))
    grid[-1][0].set_xlabel(seconds.label("time"))
    figure.align_ylabels()
    return figure


TIME_HISTORY = FigureKind(
    name="time-history",
    title="Chosen channels over time",
    channels=_chosen,
    draw=lambda source, selection: panels_over_time(source, _chosen(source, selection), selection),
)

OUTPUTS = FigureKind(
    name="outputs",
    title="The scene's declared outputs over time",
    channels=_declared,
    draw=lambda source, selection: panels_over_time(
        source, _declared(source, selection), selection
    ),
)
