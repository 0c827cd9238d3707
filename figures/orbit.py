"""Path of each journal's centre inside its clearance circle."""

from typing import Any

import numpy as np

from jointplay.figures import colours, page, sampling, scene_facts
from jointplay.figures.kind import RunFigure, Selection
from jointplay.figures.quantity import scale
from jointplay.records.arrays import Floats
from jointplay.records.run import Source

_INTERVALS = 6
"""Intervals of the axes of a panel as wide as the page: their numbers stand apart."""
_PANEL_HEIGHT = 47.0  # mm
_WIDE_PANEL_HEIGHT = 78.0


def _names(joint: str) -> tuple[str, str]:
    return f"{joint}.eccentricity_x", f"{joint}.eccentricity_y"


def _channels(source: Source, selection: Selection) -> tuple[str, ...]:
    joints = scene_facts.chosen_joints(source, selection)
    rates = [rate for joint in joints for rate in sampling.stored_rates(source, _names(joint))]
    names = [name for joint in joints for name in _names(joint)]
    return scene_facts.stored(source, [*rates, *names])


def _draw(source: Source, selection: Selection) -> page.Figure:
    joints = scene_facts.chosen_joints(source, selection)
    figure, grid, panels = page.in_columns(
        len(joints), _WIDE_PANEL_HEIGHT, _PANEL_HEIGHT, page.LEGEND_HEIGHT
    )
    metres = scale("m", np.array(list(joints.values())))
    for axes, (joint, clearance) in zip(panels, joints.items(), strict=True):
        time, path = sampling.path(source, joint, _names(joint), selection)
        x, y = (path[name] / metres.factor for name in _names(joint))
        beginning = sampling.beginning(source, time, selection)
        _orbit(axes, x, y, clearance / metres.factor, beginning)
        axes.locator_params(nbins=_INTERVALS // len(grid[0]))
        axes.set_xlabel(metres.label("eccentricity x"))
        page.corner_text(axes, f"joint {joint}, c = {clearance / metres.factor:.4g} {metres.unit}")
    for row in grid:
        row[0].set_ylabel(metres.label("eccentricity y"))
    page.legend(figure, panels[0])
    return figure


def _orbit(axes: page.Axes, x: Floats, y: Floats, radius: float, beginning: str) -> None:
    axes.plot(
        x,
        y,
        color=colours.COMPUTED,
        linewidth=0.4,
        rasterized=len(x) > page.MOST_VECTOR_POINTS,
        label=f"journal centre{beginning}",
    )
    axes.plot(x[:1], y[:1], "o", color=colours.MARKED, markersize=2.5, label="first sample")
    draw_clearance(axes, radius, linewidth=0.6, label="clearance circle")
    frame(axes, 1.12 * max(radius, float(np.nanmax(np.abs([x, y]), initial=0.0))))


def draw_clearance(axes: page.Axes, radius: float, **style: Any) -> None:
    """Draw a circle around the bearing's centre, dashed."""
    angle = np.linspace(0.0, 2.0 * np.pi, 241)
    circle = (radius * np.cos(angle), radius * np.sin(angle))
    axes.plot(*circle, color=colours.GEOMETRY, linestyle=(0, (4, 3)), **style)


def frame(axes: page.Axes, reach: float) -> None:
    """Show as much around the bearing's centre in all directions."""
    axes.set_aspect("equal")
    axes.set(xlim=(-reach, reach), ylim=(-reach, reach))


ORBIT = RunFigure(
    name="orbit",
    title="Path of each journal's centre inside its clearance circle",
    uses=("joints", "start", "stop"),
    channels=_channels,
    draw=_draw,
)
