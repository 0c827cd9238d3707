"""Phase portraits with Poincare points: eccentricity and its rate, or two chosen channels."""

from typing import NamedTuple

import numpy as np

from jointplay.figures import colours, page, sampling, scene_facts
from jointplay.figures.kind import NotDrawable, RunFigure, Selection
from jointplay.figures.quantity import scale
from jointplay.records.arrays import Flags, Floats
from jointplay.records.run import Source, inside

_PANEL_HEIGHT = 38.0  # mm
_WIDE_PANEL_HEIGHT = 60.0
_MOST_JOINTS = 6


class _Panel(NamedTuple):
    """Two channels with what their axes are called, and the joint that they are of."""

    names: tuple[str, str]
    labels: tuple[str, str]
    joint: str = ""


def _rows(source: Source, selection: Selection) -> list[list[_Panel]]:
    if selection.channels:
        if selection.joints:
            raise NotDrawable("Choose joints or channels, not both.", "joints")
        if len(selection.channels) != 2:
            sentence = "A phase portrait is drawn of two channels: position and rate."
            raise NotDrawable(sentence, "channels")
        position, rate = selection.channels
        return [[_Panel((position, rate), (position, rate))]]
    try:
        joints = list(scene_facts.chosen_joints(source, selection))
    except NotDrawable as error:
        sentence = f"{error} Or choose two channels: a position and its rate."
        raise NotDrawable(sentence, error.cause) from None
    if len(joints) > _MOST_JOINTS:
        raise NotDrawable(f"Choose at most {_MOST_JOINTS} joints for one figure.", "joints")
    return [[_of_joint(joint, axis) for axis in "xy"] for joint in joints]


def _of_joint(joint: str, axis: str) -> _Panel:
    names = (f"{joint}.eccentricity_{axis}", f"{joint}.eccentricity_rate_{axis}")
    return _Panel(names, (f"eccentricity {axis}", f"rate {axis}"), joint)


def _channels(source: Source, selection: Selection) -> tuple[str, ...]:
    rows = _rows(source, selection)
    return scene_facts.stored(source, [name for row in rows for one in row for name in one.names])


def _draw(source: Source, selection: Selection) -> page.Figure:
    rows = _rows(source, selection)
    height = _PANEL_HEIGHT * len(rows) if len(rows[0]) > 1 else _WIDE_PANEL_HEIGHT
    figure, grid = page.panels(len(rows), len(rows[0]), height + page.LEGEND_HEIGHT)
    for axes_row, panel_row in zip(grid, rows, strict=True):
        for axes, panel in zip(axes_row, panel_row, strict=True):
            _portrait(axes, source, panel, selection)
    page.legend(figure, grid[0][0])
    return figure


def _portrait(axes: page.Axes, source: Source, panel: _Panel, selection: Selection) -> None:
    if panel.joint:
        time, path = sampling.path(source, panel.joint, panel.names, selection)
    else:
        time, path = sampling.in_a_plane(source, panel.names, selection)
    moments, columns = source.sections(panel.names)
    within = inside(moments, selection.start, selection.stop)
    points = {name: columns[name][within] for name in panel.names}
    across, up = (
        scale(scene_facts.channel(source, name).unit, path[name], points[name])
        for name in panel.names
    )
    position, rate = panel.names
    axes.plot(
        path[position] / across.factor,
        path[rate] / up.factor,
        color=colours.COMPUTED,
        linewidth=0.4,
        rasterized=len(time) > page.MOST_VECTOR_POINTS,
        label=f"trajectory{sampling.beginning(source, time, selection)}",
    )
    if panel.joint and (touching := _touching(source, panel.joint, time)).any():
        axes.plot(
            path[position] / across.factor,
            np.where(touching, path[rate], np.nan) / up.factor,
            color=colours.COMPUTED,
            linewidth=1.1,
            rasterized=len(time) > page.MOST_VECTOR_POINTS,
            label="in contact",
        )
    if len(time) > 1 and all(np.ptp(path[name]) == 0.0 for name in panel.names):
        page.instead(axes, "at rest")
    elif len(points[rate]):
        axes.plot(
            points[position] / across.factor,
            points[rate] / up.factor,
            "o",
            color=colours.MARKED,
            markeredgewidth=0.0,
            rasterized=len(points[rate]) > page.MOST_VECTOR_MARKS,
            label="Poincaré points",
        )
    axes.set_xlabel(across.label(panel.labels[0]))
    axes.set_ylabel(up.label(panel.labels[1]))
    page.corner_text(axes, f"joint {panel.joint}" if panel.joint else "")


def _touching(source: Source, joint: str, time: Floats) -> Flags:
    """Return at which times [s] the journal is in contact, by the list of contacts."""
    contacts = sampling.impacts_of(source, joint)
    order = np.argsort(contacts["onset"])
    before = np.searchsorted(contacts["onset"][order], time, side="right") - 1
    ends = np.append(contacts["release"][order], -np.inf)[before]
    return np.asarray(~(ends < time) & (before >= 0), np.bool_)


PHASE_PORTRAIT = RunFigure(
    name="phase-portrait",
    title="Phase portrait with Poincaré points at each clearance joint",
    uses=("channels", "joints", "start", "stop"),
    channels=_channels,
    draw=_draw,
)
