"""Bifurcation diagram: what an observable does at the sections, for every value of a parameter."""

from dataclasses import dataclass

import numpy as np

from jointplay.figures import marks, page, study_facts
from jointplay.figures.exponents import BARS, draw_exponents
from jointplay.figures.kind import NotDrawable, Selection, StudyFigure, at_most
from jointplay.figures.parameter_axis import ParameterAxis
from jointplay.figures.quantity import alike
from jointplay.figures.study_facts import Group
from jointplay.records.arrays import Floats
from jointplay.records.channel import by_name
from jointplay.records.study import StudySource

_MOST_PANELS = 6
_FIRST_PANELS = 4
"""Observables that are shown when none are chosen."""
_PANEL_HEIGHT = 30.0  # mm
_SINGLE_HEIGHT = 50.0
_EXPONENT_HEIGHT = 20.0
_STRIP_HEIGHT = 7.0


@dataclass(frozen=True)
class _Diagram:
    """Source, points, axis and groups, which all panels share."""

    source: StudySource
    points: slice
    axis: ParameterAxis
    groups: tuple[Group, ...]
    """Points of one colour."""


def _chosen(source: StudySource, selection: Selection) -> tuple[str, ...]:
    if source.kind != "bifurcation":
        raise NotDrawable("A bifurcation diagram is drawn of a job of kind bifurcation.")
    study_facts.chosen_points(source, selection)
    names = study_facts.known(selection.channels, source.observables)
    if names:
        return at_most(_MOST_PANELS, names)
    positions = [position for position, _ in study_facts.moving_pairs(source)]
    return tuple(positions or [one.name for one in source.observables])[:_FIRST_PANELS]


def _draw(source: StudySource, selection: Selection) -> page.Figure:
    names = _chosen(source, selection)
    points = study_facts.chosen_points(source, selection)
    verdicts = study_facts.by_verdict(source)
    directions = study_facts.directions(source)
    groups = directions or verdicts or (study_facts.everything(source),)
    diagram = _Diagram(source, points, ParameterAxis(source, 0, points), groups)
    heights = [_SINGLE_HEIGHT if len(names) == 1 else _PANEL_HEIGHT] * len(names)
    if has_exponent := "lyapunov" in source.indicators:
        heights.append(_EXPONENT_HEIGHT)
    if has_strip := bool(directions and verdicts):
        heights.append(_STRIP_HEIGHT)
    entries = _legend(diagram, verdicts if has_strip else ())
    note = BARS if has_exponent else ""
    figure, panels = page.stack(heights, page.legend_rows(entries), page.caption_height(note))
    rows = [marks.sections(source, name, points) for name in names]
    units = [by_name(source.observables)[name].unit for name in names]
    for axes, name, row, unit in zip(panels, names, rows, alike(units, rows), strict=False):
        _sections(axes, diagram, unit.label(name), row / unit.factor)
    if has_exponent:
        shown = diagram.axis.shown
        draw_exponents(panels[len(names)], source, points, shown, diagram.groups)
    if has_strip:
        _verdicts(panels[-1], diagram, directions, verdicts)
    for axes in panels:
        diagram.axis.dress(axes)
    page.finish_stack(figure, panels, diagram.axis.label)
    page.legend_of_marks(figure, entries)
    page.caption(figure, note)
    return figure


def _sections(axes: page.Axes, diagram: _Diagram, label: str, rows: Floats) -> None:
    """Draw one observable at the sections of every value."""
    size = marks.size(int(np.count_nonzero(np.isfinite(rows))))
    for group in diagram.groups:
        members = group.members[diagram.points]
        across = np.repeat(diagram.axis.shown[members], rows.shape[1])
        marks.draw_cloud(axes, across, rows[members].ravel(), group.colour, size)
    axes.set_ylabel(page.in_lines(label))


def _verdicts(
    axes: page.Axes, diagram: _Diagram, directions: tuple[Group, ...], verdicts: tuple[Group, ...]
) -> None:
    """Draw one row of coloured cells for each direction."""
    edges, values = diagram.axis.edges, diagram.axis.values
    widths = np.diff(edges)
    for row, direction in enumerate(directions):
        for verdict in verdicts:
            members = (direction.members & verdict.members)[diagram.points]
            index = np.searchsorted(values, diagram.axis.shown[members])
            cells = [(float(edges[i]), float(widths[i])) for i in index]
            axes.broken_barh(cells, (row - 0.4, 0.8), color=verdict.colour, linewidth=0.0)
    axes.set_yticks(range(len(directions)), [direction.name for direction in directions])
    axes.tick_params(axis="y", length=0.0)
    axes.set_gid(page.WITHOUT_SCALE)


def _legend(diagram: _Diagram, verdicts: tuple[Group, ...]) -> dict[str, tuple[str, str]]:
    """Say what colours and signs mean: label, then marker and colour."""
    entries = {}
    if len(diagram.groups) > 1 or diagram.source.verdicts is not None:
        entries = {group.name: ("o", group.colour) for group in diagram.groups}
    entries |= {verdict.name: ("s", verdict.colour) for verdict in verdicts}
    return entries | diagram.axis.legend()


BIFURCATION = StudyFigure(
    name="bifurcation",
    title="Bifurcation diagram: observables at the sections over the parameter",
    uses=("channels", "start", "stop"),
    channels=_chosen,
    draw=_draw,
)
