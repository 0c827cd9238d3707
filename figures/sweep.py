"""Extremes or statistics over the parameters of a sweep: curves over one, a map over two."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from jointplay.figures import colours, page, study_facts
from jointplay.figures.kind import NotDrawable, Selection, StudyFigure, at_most
from jointplay.figures.parameter_axis import ParameterAxis
from jointplay.figures.quantity import Scale, largest_of, scale
from jointplay.records.arrays import Floats
from jointplay.records.channel import by_name
from jointplay.records.extremes import whole_peaks
from jointplay.records.point import PointStatus
from jointplay.records.study import StudySource

if TYPE_CHECKING:
    from matplotlib.colorbar import Colorbar
else:
    Colorbar = Any

_MOST_CURVES = 8
_MOST_MAPS = 6
_FIRST_PANELS = 4
"""Channels that are shown when none are chosen."""
_PANEL_HEIGHT = 30.0  # mm
_SINGLE_HEIGHT = 50.0
_MAP_HEIGHT = 46.0
_THIRDS = (1.0 / 6.0, 1.0 / 2.0, 5.0 / 6.0)
"""Places of three long numbers along a colour bar."""
_MOST_LETTERS = 14
"""Letters of its numbers in all that stand apart."""
_CONSTANT = 1e-9
"""Cells that differ by less of their value are the same."""
_SHARP = 1e-7
"""Share of a channel's size to which its extremes are known: those that differ by less are one."""
_MOST_NUMBERS = 60
"""Marks are drawn at the values of a curve if there are no more."""


def _varying(source: StudySource, points: slice) -> list[int]:
    """Give the columns of the parameters that differ among the points, that along x first."""
    values = source.values[points]
    columns = range(values.shape[1])
    varying = [column for column in columns if len(np.unique(values[:, column])) > 1] or [0]
    return varying[::-1] if len(source.shape) > 1 else varying


def _chosen(source: StudySource, selection: Selection) -> tuple[str, ...]:
    if source.kind == "sensitivity" or not (source.channels and source.parameters):
        raise NotDrawable("A sweep's figure needs parameters and channels with kept extremes.")
    points = study_facts.chosen_points(source, selection)
    varying = _varying(source, points)
    if len(varying) > 2:
        parameters = ", ".join(source.parameters[column].name for column in varying)
        raise NotDrawable(
            f"{parameters} vary; a picture shows one or two parameters. Choose a range of points "
            "in which no more vary, or export the table.",
            "start",
        )
    most = _MOST_CURVES if len(varying) == 1 else _MOST_MAPS
    statistics = by_name(study_facts.statistics(source))
    offered = (*source.channels, *statistics.values())
    names = at_most(most, study_facts.known(selection.channels, offered))
    if 0 < len(statistics.keys() & set(names)) < len(names):
        raise NotDrawable("One figure shows extremes or statistics; choose either.", "channels")
    return names or _first(source)


def _first(source: StudySource) -> tuple[str, ...]:
    """Give the channels that are looked at first: declared outputs, contact forces, the rest."""
    outputs = [output["name"] for output in source.attributes["scene"].get("outputs", ())]
    names = sorted(
        (one.name for one in source.channels),
        key=lambda name: (name not in outputs, not name.endswith(".normal_force")),
    )
    return tuple(names[:_FIRST_PANELS])


def _draw(source: StudySource, selection: Selection) -> page.Figure:
    names = _chosen(source, selection)
    points = study_facts.chosen_points(source, selection)
    rows = [_Row.of(source, name, points) for name in names]
    varying = _varying(source, points)
    across, *up = (ParameterAxis(source, column, points) for column in varying)
    entries = across.legend()
    height = (_MAP_HEIGHT if up else _PANEL_HEIGHT) * len(names)
    if len(names) == 1 and not up:
        height = _SINGLE_HEIGHT
    height += page.AXIS_HEIGHT + (page.LEGEND_HEIGHT if entries else 0.0)
    columns = len(rows[0].panels)
    figure, grid = page.panels(len(names), columns, height, share_x=True, share_y=bool(up))
    for panels, row in zip(grid, rows, strict=True):
        for axes, (which, values) in zip(panels, row.panels.items(), strict=True):
            if up:
                label = f"{which}\n{page.in_lines(row.label)}".strip()
                _map(figure, axes, values / row.shown.factor, label, across, up[0])
                continue
            _curve(axes, values / row.shown.factor, across)
            if panels is grid[0]:
                page.corner_text(axes, which)
        panels[0].set_ylabel(up[0].label if up else page.in_lines(row.label))
    for axes in grid[-1]:
        axes.set_xlabel(across.label)
    if not up:
        figure.align_ylabels()
    page.legend_of_marks(figure, entries)
    return figure


@dataclass(frozen=True)
class _Row:
    """Content of one row of panels: both extremes of a channel, or one statistic."""

    panels: dict[str, Floats]
    """By what it is of the channel; "" is a statistic."""
    shown: Scale
    label: str

    @classmethod
    def of(cls, source: StudySource, name: str, points: slice) -> _Row:
        statistics = by_name(study_facts.statistics(source))
        if name in statistics:
            values = source.statistics[name][points]
            shown = scale(statistics[name].unit, values)
            part, _, statistic = name.rpartition(".")
            return cls({"": values}, shown, f"{part}\n{shown.label(statistic)}")
        peaks = whole_peaks(source, name)
        extremes = {"largest": peaks.maximum[points], "smallest": peaks.minimum[points]}
        size = max(largest_of(values) for values in extremes.values())
        panels = {which: _known(values, size) for which, values in extremes.items()}
        shown = scale(by_name(source.channels)[name].unit, *panels.values())
        return cls(panels, shown, shown.label(name))


def _known(values: Floats, size: float) -> Floats:
    """Return extremes of a channel of a size, as one number if no more than rounding differs."""
    middle = float(np.nanmedian(values)) if np.isfinite(values).any() else 0.0
    if largest_of(values - middle) > _SHARP * size:
        return values
    same = 0.0 if abs(middle) <= _SHARP * size else middle
    return np.where(np.isfinite(values), same, np.nan)


def _curve(axes: page.Axes, values: Floats, parameter: ParameterAxis) -> None:
    """Draw values over one parameter."""
    order = np.argsort(parameter.shown, kind="stable")
    axes.plot(
        parameter.shown[order],
        values[order],
        color=colours.COMPUTED,
        marker="o" if len(order) <= _MOST_NUMBERS else "",
        markersize=1.6,
        linewidth=0.7,
    )
    axes.locator_params(axis="y", nbins=5)
    parameter.dress(axes, intervals=4)


def _map(
    figure: page.Figure,
    axes: page.Axes,
    values: Floats,
    label: str,
    across: ParameterAxis,
    up: ParameterAxis,
) -> None:
    """Draw a cell for each pair of values; cells without a result are shaded."""
    table = np.full((len(up.values), len(across.values)), np.nan)
    row, column = (np.searchsorted(axis.values, axis.shown) for axis in (up, across))
    table[row, column] = values
    axes.set_facecolor(colours.UNKNOWN)
    shown = np.ma.masked_invalid(table)
    drawn = axes.pcolormesh(across.edges, up.edges, shown, cmap=colours.MAP, rasterized=True)
    failed = across.status == PointStatus.failed
    axes.plot(
        across.shown[failed],
        up.shown[failed],
        "x",
        color=colours.GEOMETRY,
        markersize=3.0,
        zorder=3.0,
    )
    if across.logarithmic:
        axes.set_xscale("log")
    if up.logarithmic:
        axes.set_yscale("log")
    across.ticks(axes.xaxis, intervals=4, own=True)
    up.ticks(axes.yaxis, intervals=5, own=True)
    axes.tick_params(which="both", direction="out", top=False, right=False)
    bar = figure.colorbar(drawn, ax=axes, location="top", aspect=25.0)
    bar.ax.set_gid(page.WITHOUT_SCALE)
    bar.set_label(label)
    _number(bar, shown)


def _number(bar: Colorbar, values: np.ma.MaskedArray[Any, Any]) -> None:
    """Give a colour bar at least three numbers, or the one that all cells have."""
    from matplotlib.ticker import MaxNLocator

    low, high = float(values.min() or 0.0), float(values.max() or 0.0)
    if high - low <= _CONSTANT * max(abs(low), abs(high)):
        bar.set_ticks([low], labels=[f"{low:.4g} everywhere"])
        return
    for most in (3, 4, 5, 6):
        ticks = MaxNLocator(most, steps=[1, 2, 2.5, 5, 10]).tick_values(low, high)
        inside = [float(tick) for tick in ticks if low <= tick <= high]
        if len(inside) >= len(_THIRDS):
            break
    if sum(len(f"{tick:.6g}") for tick in inside) > _MOST_LETTERS or len(inside) < len(_THIRDS):
        decimals = -math.floor(math.log10((high - low) * _THIRDS[0]))
        inside = [round(low + share * (high - low), decimals) for share in _THIRDS]
    bar.set_ticks(inside, labels=[f"{tick:.6g}".replace("-", "−") for tick in inside])


SWEEP = StudyFigure(
    name="sweep",
    title="Extremes of channels, or statistics, over the parameters",
    uses=("channels", "start", "stop"),
    channels=_chosen,
    draw=_draw,
)
