"""Phase portraits with Poincare points: eccentricity and its rate, or two chosen channels."""

from __future__ import annotations

from typing import TYPE_CHECKING

from jointplay.figures import page, sampling, scene_facts
from jointplay.figures.errors import NotDrawable
from jointplay.figures.kind import FigureKind, Selection
from jointplay.figures.quantity import scale
from jointplay.source import Source

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_PANEL_HEIGHT = 38.0  # mm
_WIDE_PANEL_HEIGHT = 60.0
_MOST_JOINTS = 6


def _pairs(source: Source, selection: Selection) -> list[list[tuple[str, str]]]:
    """Give rows of panels, each with position and rate to draw."""
    if selection.channels:
        if len(selection.channels) != 2:
            raise NotDrawable("a phase portrait is drawn of two channels: position and rate")
        return [[(selection.channels[0], selection.channels[1])]]
    joints = list(scene_facts.chosen_joints(source, selection))
    if len(joints) > _MOST_JOINTS:
        raise NotDrawable(f"choose at most {_MOST_JOINTS} joints for one figure")
    return [
        [(f"{joint}.eccentricity_{axis}", f"{joint}.eccentricity_rate_{axis}") for axis in "xy"]
        for joint in joints
    ]


def _channels(source: Source, selection: Selection) -> tuple[str, ...]:
    rows = _pairs(source, selection)
    return scene_facts.stored(source, [name for row in rows for pair in row for name in pair])


def _draw(source: Source, selection: Selection) -> Figure:
    rows = _pairs(source, selection)
    height = _PANEL_HEIGHT * len(rows) if len(rows[0]) > 1 else _WIDE_PANEL_HEIGHT
    figure, grid = page.panels(len(rows), len(rows[0]), height)
    for panels, pairs in zip(grid, rows, strict=True):
        for axes, (position, rate) in zip(panels, pairs, strict=True):
            _portrait(axes, source, position, rate, selection)
    return figure


def _portrait(axes: Axes, source: Source, position: str, rate: str, selection: Selection) -> None:
    _, path = sampling.in_a_plane(source, (position, rate), selection)
    time, points = source.sections([position, rate])
    low, high = selection.start, selection.stop
    inside = (time >= (time.min(initial=0.0) if low is None else low)) & (
        time <= (time.max(initial=0.0) if high is None else high)
    )
    across = scale(scene_facts.channel(source, position).unit, path[position])
    up = scale(scene_facts.channel(source, rate).unit, path[rate])
    axes.plot(
        path[position] / across.factor,
        path[rate] / up.factor,
        color=page.SKY,
        linewidth=0.4,
        rasterized=len(path[position]) > page.MOST_VECTOR_POINTS,
    )
    axes.plot(
        points[position][inside] / across.factor,
        points[rate][inside] / up.factor,
        "o",
        color=page.VERMILION,
        markeredgewidth=0.0,
        rasterized=int(inside.sum()) > page.MOST_VECTOR_POINTS,
    )
    axes.set_xlabel(across.label(position))
    axes.set_ylabel(up.label(rate))


PHASE_PORTRAIT = FigureKind(
    name="phase-portrait",
    title="Phase portrait with Poincaré points at each clearance joint",
    channels=_channels,
    draw=_draw,
)
