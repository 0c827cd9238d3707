"""Curves of special orbits over two parameters: a line each, whose label has its colour."""

from dataclasses import replace
from typing import Final

import numpy as np

from jointplay.figures import colours, page
from jointplay.figures.branch import known_branches, missing
from jointplay.figures.kind import NotDrawable, Selection, StudyFigure
from jointplay.figures.over_chart import OverChart, halo
from jointplay.figures.quantity import scale
from jointplay.figures.special_names import name_special
from jointplay.records.branch import CURVES, LENGTH, SECOND, VALUE, Branch
from jointplay.records.study import StudySource

_HEIGHT = 65.0  # mm
_STYLES: Final = dict(zip(CURVES, colours.COMPARED, strict=False))
_NAMES: Final = {
    "LP": "LP fold",
    "PD": "PD period doubling",
    "GR": "GR grazing",
    "NS": "NS Neimark-Sacker",
}


def _curves(source: StudySource, selection: Selection) -> list[Branch]:
    if "labels" not in source.attributes or len(source.parameters) < 2:
        raise NotDrawable("Curves are drawn of a job of kind continuation with 'second'.")
    found = [one for one in known_branches(source, selection) if one.of]
    if not found:
        raise NotDrawable("No curve of special orbits has been found.")
    return found


def _chosen(source: StudySource, selection: Selection) -> tuple[str, ...]:
    _curves(source, selection)
    return ()


def _draw(source: StudySource, selection: Selection) -> page.Figure:
    curves = _curves(source, selection)
    if selection.over is not None:
        return _draw_over(OverChart(source, selection.over), curves)
    across, up = (
        scale(one.unit, *[curve.column(name) for curve in curves])
        for one, name in zip(source.parameters, (VALUE, SECOND), strict=True)
    )
    explained = missing(source, selection)
    figure, (axes,) = page.stack([_HEIGHT], 1, page.caption_height(explained))
    page.caption(figure, explained)
    placed = []
    for curve in curves:
        order = np.argsort(curve.column(LENGTH), kind="stable")
        x, y = curve.column(VALUE) / across.factor, curve.column(SECOND) / up.factor
        colour, dashes, _ = _STYLES[curve.of]
        (line,) = axes.plot(x[order], y[order], dashes, color=colour, linewidth=0.9)
        line.set_label(_NAMES[curve.of])
        placed.append((_behind_start(curve), x, y))
    name_special(axes, placed)
    axes.set_ylabel(up.label(source.parameters[1].name))
    page.finish_stack(figure, [axes], across.label(source.parameters[0].name), axes)
    return figure


def _draw_over(chart: OverChart, curves: list[Branch]) -> page.Figure:
    """Draw curves over the map of a chart, black, so that its colours mean what they do alone."""
    placed = chart.placed([_behind_start(curve) for curve in curves])
    figure, axes = chart.panel(len({curve.of for curve in curves}))
    for curve, (_, x, y) in zip(curves, placed, strict=True):
        order = np.argsort(curve.column(LENGTH), kind="stable")
        style: page.Style = {"color": colours.GEOMETRY, "linewidth": 0.9, "path_effects": halo()}
        (line,) = axes.plot(x[order], y[order], _STYLES[curve.of][1], **style)
        line.set_label(_NAMES[curve.of])
    name_special(axes, placed)
    chart.explain(figure, axes)
    return figure


def _behind_start(curve: Branch) -> Branch:
    """Return a curve without the special orbit that it is of."""
    return replace(curve, special=curve.special[1:])


CURVES_FIGURE = StudyFigure(
    name="curves",
    title="Folds, period doublings, Neimark-Sacker and grazing over two parameters",
    uses=("start", "stop", "over"),
    channels=_chosen,
    draw=_draw,
)
