"""Branches of periodic orbits over a parameter: stable full, unstable dashed, with their labels."""

from typing import Any

import numpy as np

from jointplay.figures import colours, page, study_facts
from jointplay.figures.kind import NotDrawable, Selection, StudyFigure, at_most
from jointplay.figures.over_chart import OverChart, halo
from jointplay.figures.over_diagram import KIND, OverDiagram
from jointplay.figures.quantity import alike, scale
from jointplay.records.arrays import Floats
from jointplay.records.branch import LENGTH, UNSTABLE, VALUE, Branch, branches
from jointplay.records.channel import by_name
from jointplay.records.study import StudySource

_MOST_PANELS = 6
_HEIGHT, _SINGLE_HEIGHT = 40.0, 65.0  # mm
_FULL, _DASHED = "-", (0.0, (4.0, 2.0))
_NEAR = 0.03
"""Share of a panel within which special orbits of a label share their name."""
_BESIDE = 0.15
"""Share of a panel's width at its right end where names stand on the left of their orbits."""
_UNNAMED = "EP"


def _chosen(source: StudySource, selection: Selection) -> tuple[str, ...]:
    if "labels" not in source.attributes:
        raise NotDrawable("Branches are drawn of a job of kind continuation.")
    if not _found(source, selection):
        raise NotDrawable("No orbit of a branch has been found.")
    names = study_facts.known(selection.channels, source.observables)
    if names:
        return at_most(_MOST_PANELS, names)
    return tuple(one.name for one in source.observables if one.name.startswith("state."))[:1]


def _found(source: StudySource, selection: Selection) -> list[Branch]:
    """Return the branches that have orbits, without curves over two parameters."""
    return [one for one in known_branches(source, selection) if not one.of]


def known_branches(source: StudySource, selection: Selection) -> list[Branch]:
    """Return the branches and curves among the chosen points that have orbits."""
    shown = study_facts.chosen_points(source, selection)
    within = range(shown.start, shown.stop)
    return [one for one in branches(source) if one.index in within and source.counts[one.index]]


def _draw(source: StudySource, selection: Selection) -> page.Figure:
    names = _chosen(source, selection)
    found = _found(source, selection)
    if selection.over is not None and selection.over.kind == KIND:
        return _draw_over_diagram(OverDiagram(source, selection.over, selection.channels), found)
    if selection.over is not None:
        return _draw_over(OverChart(source, selection.over), found)
    parameter = source.parameters[0]
    across = scale(parameter.unit, *[one.column(VALUE) for one in found])
    units = by_name(source.observables)
    values = [np.concatenate([one.column(name) for one in found]) for name in names]
    heights = [_SINGLE_HEIGHT if len(names) == 1 else _HEIGHT] * len(names)
    figure, panels = page.stack(heights, 1)
    for axes, name, unit in zip(
        panels, names, alike([units[name].unit for name in names], values), strict=True
    ):
        for branch in found:
            x, y = branch.column(VALUE) / across.factor, branch.column(name) / unit.factor
            _curve(axes, branch, x, y)
        for branch in found:
            x, y = branch.column(VALUE) / across.factor, branch.column(name) / unit.factor
            name_special(axes, branch, x, y)
        axes.set_ylabel(page.in_two_lines(unit.label(name)))
    page.finish_stack(figure, panels, across.label(parameter.name), panels[0])
    return figure


def _draw_over(chart: OverChart, found: list[Branch]) -> page.Figure:
    """Draw branches over the map of a chart, where parts of a branch may lie on one another."""
    figure, axes = chart.panel(2)
    for branch in found:
        look: page.Look = {"color": colours.GEOMETRY, "path_effects": halo()}
        _curve(axes, branch, *chart.places(branch), **look)
    for branch in found:
        name_special(axes, chart.inside(branch), *chart.places(branch))
    chart.explain(figure, axes)
    return figure


def _draw_over_diagram(diagram: OverDiagram, found: list[Branch]) -> page.Figure:
    """Draw branches over the sections of a diagram, whose stable orbits lie on these."""
    figure, panels = diagram.panels(1)
    for panel, axes in enumerate(panels):
        for branch in found:
            _curve(axes, branch, *diagram.places(branch, panel))
        for branch in found:
            name_special(axes, branch, *diagram.places(branch, panel))
    diagram.finish(figure, panels)
    return figure


def _curve(axes: page.Axes, branch: Branch, x: Floats, y: Floats, **look: Any) -> None:
    """Draw the orbits of a branch in their order along it."""
    style: page.Look = {"color": colours.COMPUTED, "linewidth": 0.9} | look
    order = np.argsort(branch.column(LENGTH), kind="stable")
    x, y, stable = x[order], y[order], branch.column(UNSTABLE)[order] == 0.0
    ends = [*(np.flatnonzero(np.diff(stable)) + 1).tolist(), len(x)]
    begin = 0
    for end in ends:
        full = bool(stable[begin:end].any())
        axes.plot(
            x[max(begin - 1, 0) : end],
            y[max(begin - 1, 0) : end],
            linestyle=_FULL if full else _DASHED,
            label="stable" if full else "unstable",
            **style,
        )
        begin = end


def name_special(axes: page.Axes, branch: Branch, x: Floats, y: Floats) -> None:
    """Mark special orbits, and write their labels where these do not lie on one another."""
    width, height = (np.ptp(limits) for limits in (axes.get_xlim(), axes.get_ylim()))
    written: list[tuple[str, float, float]] = []
    for one in branch.special:
        if one.label == _UNNAMED:
            continue
        at, up = float(x[one.row]), float(y[one.row])
        axes.plot(at, up, "o", color=colours.MARKED, markersize=2.5, zorder=3.0)
        near = any(
            one.label == label and abs(at - a) < _NEAR * width and abs(up - b) < _NEAR * height
            for label, a, b in written
        )
        if not near:
            crowd = sum(
                abs(at - a) < _NEAR * width and abs(up - b) < _NEAR * height for _, a, b in written
            )
            side = -1.0 if at > axes.get_xlim()[1] - _BESIDE * width else 1.0
            axes.annotate(
                one.label,
                (at, up),
                xytext=(side * (3.0 + 13.0 * crowd), 3.0),
                textcoords="offset points",
                horizontalalignment="right" if side < 0.0 else "left",
                fontsize=page.in_font(6.0),
            )
            written.append((one.label, at, up))


BRANCH = StudyFigure(
    name="branch",
    title="Branches of periodic orbits over the parameter, stable and unstable",
    uses=("channels", "start", "stop", "over"),
    channels=_chosen,
    draw=_draw,
)
