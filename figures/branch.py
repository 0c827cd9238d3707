"""Branches of periodic orbits over a parameter: stable full, unstable dashed, with their labels."""

from typing import Any

import numpy as np

from jointplay.figures import colours, page, study_facts
from jointplay.figures.kind import NotDrawable, Selection, StudyFigure, at_most
from jointplay.figures.over_chart import OverChart, halo
from jointplay.figures.over_diagram import KIND, OverDiagram
from jointplay.figures.quantity import alike, scale
from jointplay.figures.special_names import name_special
from jointplay.records.arrays import Floats
from jointplay.records.branch import LENGTH, UNSTABLE, VALUE, Branch, branches
from jointplay.records.channel import by_name
from jointplay.records.point import PointStatus, has_ended
from jointplay.records.study import StudySource

_MOST_PANELS = 6
_HEIGHT, _SINGLE_HEIGHT = 40.0, 65.0  # mm
_FULL, _DASHED = "-", (0.0, (4.0, 2.0))


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


def missing(source: StudySource, selection: Selection) -> str:
    """Return how many branches and curves failed or go on, in sentences; empty: none."""
    status = source.status[study_facts.chosen_points(source, selection)]
    failed = int((status == PointStatus.failed).sum())
    going = int((~has_ended(status)).sum())
    parts = {
        f"{failed} of {len(status)} branches failed.": failed,
        f"{going} of {len(status)} branches have not ended.": going,
    }
    return " ".join(sentence for sentence, count in parts.items() if count)


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
    explained = missing(source, selection)
    figure, panels = page.stack(heights, 1, page.caption_height(explained))
    page.caption(figure, explained)
    for axes, name, unit in zip(
        panels, names, alike([units[name].unit for name in names], values), strict=True
    ):
        placed = [
            (one, one.column(VALUE) / across.factor, one.column(name) / unit.factor)
            for one in found
        ]
        for branch, x, y in placed:
            _curve(axes, branch, x, y)
        name_special(axes, placed)
        axes.set_ylabel(page.in_lines(unit.label(name)))
    page.finish_stack(figure, panels, across.label(parameter.name), panels[0])
    return figure


def _draw_over(chart: OverChart, found: list[Branch]) -> page.Figure:
    """Draw branches over the map of a chart, where parts of a branch may lie on one another."""
    placed = chart.placed(found)
    figure, axes = chart.panel(2)
    for branch, x, y in placed:
        style: page.Style = {"color": colours.GEOMETRY, "path_effects": halo()}
        _curve(axes, branch, x, y, **style)
    name_special(axes, placed)
    chart.explain(figure, axes)
    return figure


def _draw_over_diagram(diagram: OverDiagram, found: list[Branch]) -> page.Figure:
    """Draw branches over the sections of a diagram, whose stable orbits lie on these."""
    figure, panels = diagram.panels(1)
    for panel, axes in enumerate(panels):
        placed = diagram.placed(found, panel)
        for branch, x, y in placed:
            _curve(axes, branch, x, y)
        name_special(axes, placed)
    diagram.finish(figure, panels)
    return figure


def _curve(axes: page.Axes, branch: Branch, x: Floats, y: Floats, **style: Any) -> None:
    """Draw the orbits of a branch in their order along it."""
    common: page.Style = {"color": colours.COMPUTED, "linewidth": 0.9}
    style = common | style
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


BRANCH = StudyFigure(
    name="branch",
    title="Branches of periodic orbits over the parameter, stable and unstable",
    uses=("channels", "start", "stop", "over"),
    channels=_chosen,
    draw=_draw,
)
