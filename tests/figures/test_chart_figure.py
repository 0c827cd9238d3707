"""The figure of a chart that is still computed: points that wait show the next coarser one."""

from dataclasses import replace

import numpy as np
import pytest
from drawn import drawn_with

from jointplay.figures import Selection, select
from jointplay.records.channel import Channel
from jointplay.records.channel_choice import NoSuchChannel
from jointplay.records.peak import PeakColumns
from jointplay.records.point import PointStatus
from jointplay.records.study import StudyDataset

SIDE = 8
VERDICTS = ("undecided", "periodic", "quasi-periodic", "chaotic", "equilibrium")


def running():
    """Return a chart of 8 by 8 of which every fourth point is known: two columns move alike."""
    y, x = (each.ravel() for each in np.indices((SIDE, SIDE)))
    known = (y % 4 == 0) & (x % 4 == 0)
    verdict = np.where(x < 4, 1.0, 3.0)
    return StudyDataset(
        attributes={
            "job": {"kind": "chart"},
            "scene": {"name": "made up", "bodies": {}, "joints": {}},
        },
        parameters=(Channel("load", "N", "load"), Channel("speed", "rad/s", "speed")),
        values=np.stack([y, x], axis=1).astype(float),
        status=np.where(known, PointStatus.done, PointStatus.waiting).astype(np.uint8),
        indicators={
            "verdict": np.where(known, verdict, np.nan),
            "period": np.where(known, np.where(x < 4, 1.0, 0.0), np.nan),
            "lyapunov": np.where(known, 1.0 * x, np.nan),
        },
        verdicts=np.where(known, verdict, -1).astype(np.int64),
        verdict_names=VERDICTS,
        grid=(SIDE, SIDE),
    )


def finished():
    """Return it with all points, and extremes of a channel: they grow with the speed, along x."""
    chart = running()
    speed = chart.values[:, 1]
    return replace(
        chart,
        status=np.full(chart.points, PointStatus.done, np.uint8),
        channels=(Channel("stroke", "m", "stroke"),),
        extremes={"stroke": PeakColumns(-speed, speed, 2.0 * speed, speed)},
    )


@pytest.mark.parametrize("selection", [None, select(running(), ["lyapunov"])])
def test_points_that_wait_show_the_next_coarser_one(selection):
    mesh = drawn_with(running(), "chart", selection).axes[0].collections[0]
    table = np.ma.asarray(mesh.get_array()).reshape(SIDE, SIDE)
    assert not np.ma.getmaskarray(table).any()
    for column in (slice(0, 4), slice(4, 8)):
        assert len(np.unique(table[:, column])) == 1
    assert table[0, 0] != table[0, 7]


@pytest.mark.parametrize("name", ["motion", "lyapunov"])
def test_the_caption_says_how_many_points_are_computed_as_long_as_others_wait(name):
    told = [
        drawn_with(chart, "chart", select(chart, [name])).get_supxlabel()
        for chart in (running(), finished())
    ]
    assert told == ["4 of 64 points are computed; the others look as the nearest of these.", ""]


def test_quantities_are_chosen_by_their_names():
    assert select(running(), ["motion"]) == Selection(channels=("motion",))
    with pytest.raises(NoSuchChannel, match="did you mean lyapunov"):
        select(running(), ["lyapunow"])


@pytest.mark.parametrize(("name", "factor"), [("stroke.minimum", -1.0), ("stroke.maximum", 2.0)])
def test_an_extreme_is_a_quantity_of_a_chart(name, factor):
    chart = finished()
    axes = drawn_with(chart, "chart", select(chart, [name])).axes
    table = np.ma.asarray(axes[0].collections[0].get_array()).reshape(SIDE, SIDE)
    np.testing.assert_array_equal(table, [factor * np.arange(SIDE)] * SIDE)
    assert axes[1].get_xlabel() == f"{name.split('.')[1]} of stroke [m]"


def test_extremes_of_a_chart_have_its_axes():
    chart, *_ = drawn_with(finished(), "chart", None).axes
    sweep, *_ = drawn_with(finished(), "sweep", None).axes
    assert (sweep.get_xlabel(), sweep.get_ylabel()) == (chart.get_xlabel(), chart.get_ylabel())


def test_what_is_counted_has_whole_numbers_beside_its_colours():
    figure = drawn_with(running(), "chart", select(running(), ["period"]))
    (bar,) = (axes for axes in figure.axes if axes.get_label() == "<colorbar>")
    assert bar.get_xticks().tolist() == [0.0, 1.0]


def test_a_quantity_that_is_the_same_everywhere_is_one_number():
    found = running()
    ended = np.full(found.points, PointStatus.done, np.uint8)
    same = found.indicators | {"lyapunov": np.full(found.points, 0.25)}
    found = replace(found, status=ended, indicators=same)
    figure = drawn_with(found, "chart", select(found, ["lyapunov"]))
    (bar,) = (axes for axes in figure.axes if axes.get_label() == "<colorbar>")
    assert [label.get_text() for label in bar.get_xticklabels()] == ["0.25 everywhere"]


def test_a_logarithmic_axis_has_the_numbers_of_its_parameter():
    spaced = running()
    values = spaced.values * [1.0, 0.0] + [0.0, 20.0] * 1.1**spaced.values
    (axes, *_) = drawn_with(replace(spaced, values=values), "chart", None).axes
    assert axes.get_xscale() == "log"
    numbers = {label.get_text() for label in axes.get_xticklabels()}
    assert numbers >= {"20", "25", "30", "35"}


@pytest.mark.parametrize(("odd", "ends"), [(0.0, "neither"), (1e3, "max"), (-1e3, "min")])
def test_colours_are_said_to_go_on_only_where_values_lie_beyond_them(odd, ends):
    found = running()
    values = np.repeat([0.0, 1.0], found.points // 2)
    values[0] += odd
    known = replace(
        found,
        status=np.full(found.points, PointStatus.done, np.uint8),
        indicators=found.indicators | {"lyapunov": values},
    )
    figure = drawn_with(known, "chart", select(known, ["lyapunov"]))
    assert figure.axes[0].collections[0].colorbar.extend == ends


def test_what_a_point_came_to_before_it_failed_has_no_colour():
    chart = finished()
    failed = (chart.values == [2.0, 5.0]).all(axis=1)
    chart.status[failed] = PointStatus.failed
    chosen = select(chart, ["stroke.maximum"])
    mesh = drawn_with(chart, "chart", chosen).axes[0].collections[0]
    blank = np.ma.getmaskarray(np.ma.asarray(mesh.get_array()).reshape(SIDE, SIDE))
    assert np.argwhere(blank).tolist() == [[2, 5]]
