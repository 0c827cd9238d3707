"""Branches and curves of periodic orbits over the map of a chart of the same parameters."""

from dataclasses import replace

import numpy as np
import pytest
from branches import HEIGHTS, folded, over_two_parameters
from drawn import drawn_with

from jointplay import figures
from jointplay.figures import NotDrawable, Selection, colours
from jointplay.records.channel import Channel
from jointplay.records.point import PointStatus
from jointplay.records.study import StudyDataset

SIDE = 5
WIDTH, SPEED = Channel("width", "m", "width"), Channel("speed", "rad/s", "speed")


def chart(up=WIDTH, across=SPEED):
    """Return a chart of 5 by 5: `up` from 0 to 4, `across` from -8 to 8; the right half strikes."""
    y, x = (each.ravel() for each in np.indices((SIDE, SIDE)))
    verdict = np.where(x < 3, 1, 3)
    return StudyDataset(
        attributes={"job": {"kind": "chart"}, "scene": {"name": "", "bodies": {}, "joints": {}}},
        parameters=(up, across),
        values=np.stack([1.0 * y, 4.0 * (x - 2)], axis=1),
        status=np.full(SIDE * SIDE, PointStatus.done, np.uint8),
        indicators={"verdict": 1.0 * verdict, "period": np.where(x < 3, 1.0, 0.0)},
        verdicts=verdict,
        verdict_names=("undecided", "periodic", "quasi-periodic", "chaotic", "equilibrium"),
        grid=(SIDE, SIDE),
    )


def told(source, width):
    """Return a study whose job's scene tells a width."""
    scene = {"preset": "made up", "parameters": {"width": width}}
    job = source.attributes["job"] | {"scene": scene}
    return replace(source, attributes=source.attributes | {"job": job})


def drawn(source, name, **selection):
    figure = drawn_with(source, name, Selection(**selection))
    return figure, figure.axes[0]


def test_curves_lie_over_the_map_at_the_parameters_of_their_orbits():
    figure, axes = drawn(over_two_parameters(), "curves", over=chart())
    order = [4, 3, 0, 1, 2]
    line = axes.lines[0]
    assert line.get_xdata() == pytest.approx(HEIGHTS[order] ** 3)
    assert line.get_ydata() == pytest.approx(HEIGHTS[order] ** 2)
    assert line.get_color() == colours.GEOMETRY
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("speed [rad/s]", "width [m]")
    assert axes.get_xlim() == pytest.approx((-10.0, 10.0))
    assert axes.get_ylim() == pytest.approx((-0.5, 4.5))
    table = np.ma.asarray(axes.collections[0].get_array()).reshape(SIDE, SIDE)
    assert len(np.unique(table)) == 2
    named = [one.get_text() for one in figure.legends[0].get_texts()]
    assert named[-1] == "LP fold"
    assert len(named) == 3


def test_no_line_of_the_legend_touches_its_name():
    figure, _ = drawn(over_two_parameters(), "curves", over=chart())
    (legend,) = figure.legends
    line, name = legend.get_lines()[-1], legend.get_texts()[-1]
    gap = name.get_window_extent().x0 - line.get_window_extent().x1
    assert gap > 0.3 * name.get_size() * figure.dpi / 72.0  # half an em, less half the line


def test_axes_are_found_by_their_names():
    _, axes = drawn(over_two_parameters(), "curves", over=chart(SPEED, WIDTH))
    assert axes.lines[0].get_ydata() == pytest.approx(HEIGHTS[[4, 3, 0, 1, 2]] ** 3)


def test_special_orbits_beyond_the_map_are_not_named():
    small = chart()
    small.values[:, 0] *= 0.25  # widths up to 1, without the ends of the curve at 4
    _, axes = drawn(over_two_parameters(), "curves", over=small)
    assert [one.get_text() for one in axes.texts] == ["CP"]
    assert axes.get_ylim() == pytest.approx((-0.125, 1.125))


def test_a_branch_lies_at_the_value_of_the_parameter_that_does_not_vary():
    _, axes = drawn(told(folded(), 2.0), "branch", over=chart())
    full, dashed = axes.lines[:2]
    assert (full.get_linestyle(), dashed.get_linestyle()) == ("-", "--")
    assert full.get_xdata() == pytest.approx(HEIGHTS[:3] ** 2 - 1.0)
    assert set(full.get_ydata()) == {2.0}
    assert [one.get_text() for one in axes.texts] == ["LP", "MX"]


@pytest.mark.parametrize(
    ("source", "name", "over", "says"),
    [
        (
            folded(),
            "branch",
            folded(),
            "branches over one of kind bifurcation, too; this one is of kind continuation",
        ),
        (told(folded(), None), "branch", chart(), "axis is width, of which these orbits tell no"),
        (
            told(over_two_parameters(), 1.0),
            "curves",
            chart(WIDTH, Channel("width", "m", "width")),
            "The chart is over width and width, these orbits over speed",
        ),
    ],
)
def test_what_cannot_lie_beneath_is_said(source, name, over, says):
    with pytest.raises(NotDrawable, match=says) as refusal:
        figures.draw(source, name, Selection(over=over))
    assert refusal.value.cause == "over"


def test_other_figures_have_nothing_beneath():
    with pytest.raises(NotDrawable, match="does not depend on over"):
        figures.draw(chart(), "chart", Selection(over=chart()))


def test_orbits_that_all_lie_beyond_the_map_are_refused():
    small = replace(chart(), values=chart().values * [1.0, 0.1] + [5.0, 0.0])
    with pytest.raises(NotDrawable, match="No orbit lies within the axes") as refused:
        figures.draw(over_two_parameters(), "curves", Selection(over=small))
    assert refused.value.cause == "over"
