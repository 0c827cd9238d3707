"""Figures of sweeps: extremes and statistics over parameters, and maps of two."""

from dataclasses import replace

import numpy as np
import pytest
from closed_form_study import sweep
from drawn import drawn_with, stand_apart

from jointplay import figures
from jointplay.figures import NotDrawable, Selection, page, saving
from jointplay.records.point import PointStatus


def test_extremes_of_a_sweep_are_drawn_over_its_parameter_in_order():
    source = sweep((30,))
    order = np.random.default_rng(1).permutation(30)
    shuffled = replace(
        source,
        values=source.values[order],
        extremes={
            name: type(peaks)(*(column[order] for column in peaks))
            for name, peaks in source.extremes.items()
        },
    )
    largest, smallest = drawn_with(shuffled, "left.normal_force", None).axes
    np.testing.assert_allclose(largest.lines[0].get_xdata(), source.values[:, 0] * 1e3)
    force = source.extremes["left.normal_force"]
    np.testing.assert_allclose(largest.lines[0].get_ydata(), force.maximum * 1e-3)
    np.testing.assert_allclose(smallest.lines[0].get_ydata(), force.minimum)


def test_what_a_point_came_to_before_it_failed_is_not_drawn():
    source = sweep((30,))
    source.status[4] = PointStatus.failed
    largest, smallest = drawn_with(source, "left.normal_force", None).axes
    for axes in (largest, smallest):
        assert np.flatnonzero(np.isnan(axes.lines[0].get_ydata())).tolist() == [4]
    assert np.isfinite(source.peaks("left.normal_force").maximum[4])


def test_a_statistic_is_drawn_over_its_parameter():
    source = sweep((30,))
    name = "left.normal_force.root_mean_square"
    (axes,) = drawn_with(source, name, None).axes
    np.testing.assert_allclose(axes.lines[0].get_ydata(), source.statistics[name] * 1e-3)
    assert axes.get_ylabel() == "left.normal_force\nroot_mean_square [kN]"


def test_a_map_has_each_value_in_the_cell_of_its_parameters():
    source = sweep((8, 6), failed=(3,))
    largest = drawn_with(source, "stroke", None).axes[0]
    (mesh,) = largest.collections
    table = np.ma.filled(mesh.get_array(), np.nan)
    expected = source.extremes["stroke"].maximum.reshape(8, 6).T.copy()
    np.testing.assert_allclose(table, expected)
    assert np.isnan(table).sum() == 1


def test_a_range_in_which_two_parameters_vary_is_a_map():
    source = sweep((4, 3, 5))
    with pytest.raises(NotDrawable, match="play, friction, speed vary"):
        figures.draw(source, "sweep")
    assert figures.render(source, "sweep", "png", Selection(start=0, stop=15))


def test_long_numbers_of_a_map_stand_apart():
    source = sweep((8, 6))
    stroke = source.extremes["stroke"]
    near = stroke._replace(maximum=0.52725 + 0.4 * (stroke.maximum - 0.527))
    peaks = {**source.extremes, "stroke": near}
    with page.style():
        figure = figures.draw(replace(source, extremes=peaks), "sweep", None)
        saving.save(figure, "png")
        figure.draw_without_rendering()
        stand_apart(figure)


def test_every_colour_bar_has_three_numbers_or_says_that_all_are_the_same():
    figure = drawn_with(sweep((8, 6)), "sweep", None)
    bars = [axes for axes in figure.axes if axes.get_gid() == page.WITHOUT_SCALE]
    assert len(bars) == 4
    for bar in bars:
        low, high = sorted(bar.get_xlim())
        shown = [
            label.get_text()
            for place, label in zip(bar.get_xticks(), bar.get_xticklabels(), strict=True)
            if low <= place <= high
        ]
        assert len(shown) >= 3 or shown == ["0 everywhere"]


def test_what_rounding_leaves_of_an_extreme_is_no_map():
    source = sweep((4, 3))
    peaks = source.extremes["left.normal_force"]
    noise = -1e-9 * peaks.maximum * np.arange(12)  # forces that no step makes exactly zero
    extremes = {"left.normal_force": peaks._replace(minimum=noise)}
    figure = drawn_with(replace(source, extremes=extremes), "left.normal_force", None)
    maps = [axes for axes in figure.axes if axes.get_gid() != page.WITHOUT_SCALE]
    shown = [axes.collections[0].get_array().compressed() for axes in maps]
    assert len(np.unique(shown[0])) > 1
    assert not shown[1].any()
