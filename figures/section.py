"""Poincare sections of a study's points: a position against its rate, one mark a section."""

import numpy as np

from jointplay.figures import marks, page, study_facts
from jointplay.figures.kind import NotDrawable, Selection, StudyFigure
from jointplay.figures.quantity import scale
from jointplay.records.arrays import Floats
from jointplay.records.branch import VALUE
from jointplay.records.channel import by_name
from jointplay.records.point import PointStatus
from jointplay.records.study import StudySource

_MOST_PANELS = 8
_INTERVALS = 8
"""Intervals of the axis of a panel as wide as the page: its numbers stand apart."""
_MARGIN = 0.08
"""White beside the marks, in their span: a few of them may be at its ends alone."""
_PANEL_HEIGHT = 40.0  # mm
_SINGLE_HEIGHT = 65.0


def _pairs(source: StudySource, selection: Selection) -> list[tuple[str, str]]:
    if not source.observables:
        raise NotDrawable("Sections are drawn of a job that records them, not of a sweep.")
    points = study_facts.chosen_points(source, selection)
    if source.parameters and points.stop - points.start > 1:
        raise NotDrawable(
            "Choose one point of the study: its sections differ from those of the others.", "start"
        )
    names = study_facts.known(selection.channels, source.observables)
    if selection.joints and names:
        raise NotDrawable("Choose joints or channels, not both.", "joints")
    if names:
        if len(names) != 2:
            raise NotDrawable("A section is drawn of two channels, across and up.", "channels")
        return [(names[0], names[1])]
    pairs = study_facts.moving_pairs(source)
    for joint in selection.joints:
        if not any(position.startswith(f"{joint}.eccentricity_") for position, _ in pairs):
            held = study_facts.fixed(source)
            why = f" The section holds {held}." if held.startswith(f"{joint}.") else ""
            sentence = f"No eccentricity of a joint {joint!r} was observed.{why}"
            raise NotDrawable(sentence, "joints")
    if selection.joints:
        pairs = [pair for pair in pairs if pair[0].rpartition(".")[0] in selection.joints]
    of_joints = [pair for pair in pairs if ".eccentricity_" in pair[0]]
    if not pairs:
        raise NotDrawable("No position was observed with its rate; choose two channels.")
    return (of_joints or pairs)[:_MOST_PANELS]


def _channels(source: StudySource, selection: Selection) -> tuple[str, ...]:
    return tuple(name for pair in _pairs(source, selection) for name in pair)


def _draw(source: StudySource, selection: Selection) -> page.Figure:
    pairs = _pairs(source, selection)
    points = study_facts.chosen_points(source, selection)
    if not source.counts[points].any():
        raise NotDrawable(_why_empty(source, points), "name" if source.points == 1 else "start")
    verdicts = [one for one in study_facts.by_verdict(source) if one.members[points].any()]
    legend_height = page.LEGEND_HEIGHT if verdicts else 0.0
    sentence = _of_point(source, points.start) if points.stop - points.start == 1 else ""
    beside = legend_height + page.caption_height(sentence)
    figure, grid, panels = page.in_columns(len(pairs), _SINGLE_HEIGHT, _PANEL_HEIGHT, beside)
    for axes, pair in zip(panels, pairs, strict=True):
        _scatter(axes, source, pair, points, verdicts or [study_facts.everything(source)])
        axes.locator_params(axis="x", nbins=_INTERVALS // len(grid[0]))
    figure.align_ylabels()
    page.caption(figure, sentence)
    page.legend_of_marks(figure, {one.name: ("o", one.colour) for one in verdicts})
    return figure


def _why_empty(source: StudySource, points: slice) -> str:
    if (source.status[points] == PointStatus.done).all():
        return "The condition of the section was never met there."
    return "No section was recorded there yet."


def _scatter(
    axes: page.Axes,
    source: StudySource,
    pair: tuple[str, str],
    points: slice,
    groups: list[study_facts.Group],
) -> None:
    values = [_sections(source, name, points) for name in pair]
    units = [by_name(source.observables)[name].unit for name in pair]
    across, up = (scale(unit, one) for unit, one in zip(units, values, strict=True))
    size = marks.size(values[0].size)
    for group in groups:
        x, y = (one[group.members[points]].ravel() for one in values)
        marks.draw_cloud(axes, x / across.factor, y / up.factor, group.colour, size)
    axes.margins(_MARGIN)
    for axis, unit, name in ((axes.xaxis, across, pair[0]), (axes.yaxis, up, pair[1])):
        axis.set_label_text(_with_offset(axis, page.in_lines(unit.label(_short(name)))))
    parts = {name.rpartition(".")[0] for name in pair}
    if len(parts) == 1:
        page.corner_text(axes, parts.pop())


def _sections(source: StudySource, name: str, points: slice) -> Floats:
    """Return a channel at sections; one that the section holds without its rounding."""
    values = marks.sections(source, name, points)
    if name != study_facts.fixed(source):
        return values
    return np.where(np.isnan(values), values, np.nanmean(values))


def _with_offset(axis: page.Axis, label: str) -> str:
    """Return a label with what an axis leaves out of its numbers, in place of a text across it."""
    numbers = axis.get_major_formatter()
    numbers.set_locs(axis.get_majorticklocs().tolist())
    offset = numbers.get_offset()
    axis.get_offset_text().set_visible(False)
    return f"{label}  {offset}" if offset else label


def _of_point(source: StudySource, point: int) -> str:
    """Say the parameters of a point, how many sections it has, and the ground of its verdict."""
    if "labels" in source.attributes:
        return _of_branch(source, point)
    shown = []
    for parameter, value in zip(source.parameters, source.values[point], strict=True):
        unit = scale(parameter.unit, np.array([value]))
        shown.append(f"{parameter.name} = {value / unit.factor:.6g} {unit.unit}".rstrip())
    shown.append(f"{int(source.counts[point])} sections")
    reason = source.reasons.get(point, "")
    return ", ".join(shown) + (f". {reason[:1].upper()}{reason[1:]}" if reason else "")


def _of_branch(source: StudySource, point: int) -> str:
    """Say over which values of its parameter a branch has its orbits; each has one section here."""
    values = marks.sections(source, VALUE, slice(point, point + 1))
    unit = scale(source.parameters[0].unit, values)
    low, high = np.nanmin(values) / unit.factor, np.nanmax(values) / unit.factor
    count = int(source.counts[point])
    name = source.parameters[0].name
    return f"{name} = {low:.6g} to {high:.6g} {unit.unit}".rstrip() + f", {count} orbits"


def _short(name: str) -> str:
    """Give the quantity of a channel as words; the panel says whose it is."""
    return name.rpartition(".")[2].replace("_", " ")


SECTION = StudyFigure(
    name="section",
    title="Poincaré sections: positions against their rates",
    uses=("channels", "joints", "start", "stop"),
    channels=_channels,
    draw=_draw,
)
