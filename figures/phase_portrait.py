"""Phase portraits with Poincare points: eccentricity and its rate, or two chosen channels."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from jointplay.figures import page, sampling, scene_facts, smooth
from jointplay.figures.errors import NotDrawable
from jointplay.figures.kind import RunFigure, Selection
from jointplay.figures.quantity import scale
from jointplay.records.run import Floats, Source, inside

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_PANEL_HEIGHT = 38.0  # mm
_WIDE_PANEL_HEIGHT = 60.0
_MOST_JOINTS = 6


@dataclass(frozen=True)
class _Panel:
    """Two channels with what their axes are called."""

    position: str
    rate: str
    position_label: str
    rate_label: str
    joint: str = ""


def _rows(source: Source, selection: Selection) -> list[list[_Panel]]:
    if selection.channels:
        if selection.joints:
            raise NotDrawable("Choose joints or channels, not both.", "joints")
        if len(selection.channels) != 2:
            sentence = "A phase portrait is drawn of two channels: position and rate."
            raise NotDrawable(sentence, "channels")
        return [[_Panel(*selection.channels, *selection.channels)]]
    joints = list(scene_facts.chosen_joints(source, selection))
    if len(joints) > _MOST_JOINTS:
        raise NotDrawable(f"Choose at most {_MOST_JOINTS} joints for one figure.", "joints")
    return [
        [
            _Panel(
                f"{joint}.eccentricity_{axis}",
                f"{joint}.eccentricity_rate_{axis}",
                f"eccentricity {axis}",
                f"rate {axis}",
                joint,
            )
            for axis in "xy"
        ]
        for joint in joints
    ]


def _channels(source: Source, selection: Selection) -> tuple[str, ...]:
    names = [
        name
        for row in _rows(source, selection)
        for panel in row
        for name in (panel.position, panel.rate)
    ]
    return scene_facts.stored(source, names)


def _draw(source: Source, selection: Selection) -> Figure:
    rows = _rows(source, selection)
    height = _PANEL_HEIGHT * len(rows) if len(rows[0]) > 1 else _WIDE_PANEL_HEIGHT
    figure, grid = page.panels(len(rows), len(rows[0]), height + page.LEGEND_HEIGHT)
    for axes_row, panel_row in zip(grid, rows, strict=True):
        for axes, panel in zip(axes_row, panel_row, strict=True):
            _portrait(axes, source, panel, selection)
    page.legend(figure, grid[0][0])
    return figure


def _portrait(axes: Axes, source: Source, panel: _Panel, selection: Selection) -> None:
    names = (panel.position, panel.rate)
    if panel.joint:
        time, path = smooth.path(source, panel.joint, names, selection)
    else:
        time, path = sampling.in_a_plane(source, names, selection)
    points = _sections(source, names, selection)
    across, up = (
        scale(scene_facts.channel(source, name).unit, path[name], points[name]) for name in names
    )
    axes.plot(
        path[panel.position] / across.factor,
        path[panel.rate] / up.factor,
        color=page.BLUE,
        linewidth=0.4,
        rasterized=len(path[panel.rate]) > page.MOST_VECTOR_POINTS,
        label=f"trajectory{sampling.beginning(source, time, selection)}",
    )
    if len(points[panel.rate]):
        axes.plot(
            points[panel.position] / across.factor,
            points[panel.rate] / up.factor,
            "o",
            color=page.VERMILION,
            markeredgewidth=0.0,
            rasterized=len(points[panel.rate]) > page.MOST_VECTOR_MARKS,
            label="Poincaré points",
        )
    axes.set_xlabel(across.label(panel.position_label))
    axes.set_ylabel(up.label(panel.rate_label))
    page.corner_text(axes, f"joint {panel.joint}" if panel.joint else "")


def _sections(source: Source, names: tuple[str, str], selection: Selection) -> dict[str, Floats]:
    """Give the Poincare points inside the window of time."""
    time, points = source.sections(names)
    shown = inside(time, selection.start, selection.stop)
    return {name: points[name][shown] for name in names}


PHASE_PORTRAIT = RunFigure(
    name="phase-portrait",
    title="Phase portrait with Poincaré points at each clearance joint",
    uses=("channels", "joints", "start", "stop"),
    channels=_channels,
    draw=_draw,
)
