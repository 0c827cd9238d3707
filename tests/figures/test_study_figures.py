"""Figures of studies: what they show, and what they refuse."""

from dataclasses import replace

import numpy as np
import pytest
from closed_form_study import accuracy_study, bifurcation, calibration, one_point, sweep
from drawn import drawn_with, stand_apart
from matplotlib.colors import to_hex

from jointplay import figures
from jointplay.figures import NotDrawable, Selection, UnknownFigure, colours, page, saving
from jointplay.records.channel import Channel
from jointplay.records.point import PointStatus
from jointplay.records.study import StudyDataset


@pytest.mark.parametrize(
    ("source", "names"),
    [
        (bifurcation(points=3), ["bifurcation"]),
        (one_point(), ["section"]),
        (one_point("ensemble", 3), ["section"]),
        (sweep(), ["sweep"]),
        (sweep((3, 3, 3)), []),
        (accuracy_study(), ["work-precision"]),
        (calibration(), ["calibration"]),
    ],
    ids=[
        "bifurcation",
        "poincare",
        "ensemble",
        "sweep",
        "sweep of three",
        "accuracy-study",
        "calibration",
    ],
)
def test_the_list_holds_what_can_be_drawn_without_a_choice(source, names):
    assert [listed.name for listed in figures.available(source)] == names


def test_errors_stand_over_evaluations_and_what_is_refused_is_open():
    source = accuracy_study()
    above, _ = drawn_with(source, "work-precision", None).axes
    line, full, opened = above.lines[3:6]  # of the second method
    cost, error = (source.statistics[name][10:18] for name in ("evaluations", "error"))
    np.testing.assert_array_equal(line.get_xydata(), np.column_stack([cost, error]))
    np.testing.assert_array_equal(full.get_xydata(), np.column_stack([cost, error])[1:])
    np.testing.assert_array_equal(opened.get_xydata(), [[cost[0], error[0]]])
    assert opened.get_markerfacecolor() == "white"


def test_where_nothing_takes_energy_there_is_no_panel_of_it():
    (only,) = drawn_with(accuracy_study(lossless=True), "work-precision", None).axes
    assert only.get_ylabel() == "error"
    assert only.get_xlabel().startswith("evaluations")


def test_work_and_precision_are_drawn_of_what_has_been_compared():
    with pytest.raises(NotDrawable, match="No run has been compared"):
        figures.draw(accuracy_study(2), "work-precision")
    (legend,) = drawn_with(accuracy_study(13), "work-precision", None).legends
    assert [text.get_text() for text in legend.get_texts()] == ["bogacki-shampine", "tsitouras"]
    with pytest.raises(NotDrawable, match="of an accuracy-study"):
        figures.draw(sweep(), "work-precision")


def test_a_calibration_shows_its_search_and_every_miss_in_tolerances():
    search, misses = drawn_with(calibration(), "calibration", None).axes
    np.testing.assert_array_equal(search.lines[0].get_ydata(), [np.nan, 10.0, 2.0, 1.0])
    assert all(generation.is_integer() for generation in search.get_xticks().tolist())
    bars, marks = misses.lines[2::2], misses.lines[3::2]
    assert [list(bar.get_ydata()) for bar in bars] == [[-2.0, 2.0], [0.0, 2.0]]
    assert [float(mark.get_ydata()[0]) for mark in marks] == [1.0, 0.0]


@pytest.mark.parametrize(
    ("found", "said"),
    [
        ({}, ""),
        ({"cost": 9.0}, " Nothing fits: misses are larger than tolerances explain."),
        (
            {"settled": False},
            " The search ended before its candidates were alike."
            " More may fit equally well than bars show.",
        ),
    ],
)
def test_a_calibration_says_what_its_search_did_not_reach(found, said):
    caption = drawn_with(calibration(**found), "calibration", None).get_supxlabel()
    assert caption.replace("\n", " ").endswith(f"Bars: what these give.{said}")


def test_a_calibration_is_drawn_once_its_search_has_ended():
    with pytest.raises(NotDrawable, match="did not end"):
        figures.draw(calibration(ended=False), "calibration")
    with pytest.raises(NotDrawable, match="of a calibration"):
        figures.draw(sweep(), "calibration")


def marks_of(axes):
    """The clouds of marks by colour, as rows of x and y."""
    return {
        to_hex(line.get_color()).upper(): np.column_stack(line.get_data())
        for line in axes.lines
        if line.get_marker() == "o"
    }


def test_a_diagram_shows_every_section_at_its_value():
    source = bifurcation(points=20, record=7)
    (axes,) = drawn_with(source, "left.eccentricity_x", None).axes
    (marks,) = marks_of(axes).values()
    rows = source.section_values["left.eccentricity_x"]
    expected = np.column_stack([np.repeat(source.values[:, 0], 7), rows.ravel()]) * 1e3
    np.testing.assert_allclose(marks, expected)  # drawn in mm


def test_verdicts_colour_the_sections_of_their_values():
    source = bifurcation(points=60, record=5, judged=True)
    axes, exponents = drawn_with(source, "block.x", None).axes
    marks = marks_of(axes)
    for verdict, colour in ((1, colours.PERIODIC), (3, colours.CHAOTIC), (0, colours.UNDECIDED)):
        judged = source.values[source.verdicts == verdict, 0]
        np.testing.assert_allclose(np.unique(marks[colour.upper()][:, 0]), judged * 1e3)
    assert exponents.get_ylabel() == "exponent [1/s]"
    shown = np.concatenate([rows[:, 1] for rows in marks_of(exponents).values()])
    np.testing.assert_array_equal(np.sort(shown), np.sort(source.indicators["lyapunov"]))


@pytest.mark.parametrize("least", [-140.0, -9.0, -0.3])
def test_a_low_panel_of_exponents_has_numbers_to_read_them_by(least):
    source = bifurcation(points=60, record=5, judged=True)
    source.indicators["lyapunov"] = np.linspace(least, -0.1 * least, 60)
    _, exponents = drawn_with(source, "block.x", None).axes
    low, high = exponents.get_ylim()
    assert sum(low <= number <= high for number in exponents.get_yticks()) >= 3


def test_names_of_special_orbits_stay_within_the_panel():
    columns = {"value": [1.0, 2.0, 1.0], "length": [0.0, 1.0, 2.0], "label": [0.0, 1.0, 0.0]}
    columns |= {"bound": [0.0] * 3, "unstable": [0.0, 0.0, 1.0], "state.x": [0.0, 1.0, 2.0]}
    source = StudyDataset(
        attributes={"job": {"kind": "continuation"}, "labels": {"": "", "LP": "fold"}},
        parameters=(Channel("speed", "rad/s", "speed"),),
        values=np.ones((1, 1)),
        status=np.array([PointStatus.done], dtype=np.uint8),
        observables=tuple(Channel(name, "1", name) for name in columns),
        times=np.ones((1, 3)),
        section_values={name: np.array([rows]) for name, rows in columns.items()},
    )
    figure = drawn_with(source, "branch", None)
    (axes,) = figure.axes
    (name,) = (text for text in axes.texts if text.get_text() == "LP")
    assert name.get_window_extent().x1 < axes.get_window_extent().x1


def test_directions_have_two_colours_and_their_verdicts_a_strip():
    source = bifurcation(points=40, record=5, judged=True, both=True)
    axes, _, strip = drawn_with(source, "block.x", None).axes
    marks = marks_of(axes)
    np.testing.assert_allclose(
        marks[colours.FORWARD.upper()][:, 1], source.section_values["block.x"][:40].ravel()
    )
    np.testing.assert_allclose(
        marks[colours.BACKWARD.upper()][:, 1], source.section_values["block.x"][40:].ravel()
    )
    assert [label.get_text() for label in strip.get_yticklabels()] == ["forward", "backward"]
    cells = sum(len(one.get_paths()) for one in strip.collections)
    assert cells == 80


def test_failed_values_are_marked_and_unfinished_ranges_shaded():
    source = bifurcation(points=60, failed=(7, 30), unfinished=range(40, 50))
    (axes,) = drawn_with(source, "block.x", None).axes
    (crosses,) = [line for line in axes.lines if line.get_marker() == "x"]
    np.testing.assert_allclose(crosses.get_xdata(), source.values[[7, 30], 0] * 1e3)
    (shade,) = axes.patches
    low, high = source.values[[39, 40], 0].mean(), source.values[[49, 50], 0].mean()
    assert (shade.get_x(), shade.get_width()) == pytest.approx((low * 1e3, (high - low) * 1e3))


def test_values_spaced_by_ratio_have_a_logarithmic_axis():
    spaced = bifurcation(points=30, logarithmic=True, low=1e-6)
    assert drawn_with(spaced, "block.x", None).axes[0].get_xscale() == "log"
    assert drawn_with(bifurcation(low=1e-6), "block.x", None).axes[0].get_xscale() == "linear"


def test_a_range_of_points_is_a_part_of_the_diagram():
    source = bifurcation(points=60)
    (axes,) = drawn_with(source, "block.x", Selection(start=10, stop=20)).axes
    (marks,) = marks_of(axes).values()
    np.testing.assert_allclose(np.unique(marks[:, 0]), source.values[10:20, 0] * 1e3)


def test_a_diagram_of_a_million_sections_is_no_large_file():
    source = bifurcation(points=1000, record=1000)
    assert len(figures.render(source, "bifurcation", "svg")) < 1_500_000


def test_a_section_shows_each_position_against_its_rate():
    source = one_point(record=50)
    panels = drawn_with(source, "section", None).axes
    assert [axes.get_xlabel() for axes in panels] == ["eccentricity x [mm]", "eccentricity y [mm]"]
    (marks,) = marks_of(panels[0]).values()
    sections = source.section_values
    expected = np.stack(
        [sections["left.eccentricity_x"][0], sections["left.eccentricity_rate_x"][0]], axis=1
    )
    np.testing.assert_allclose(marks, expected * 1e3)


def test_angles_that_go_round_are_drawn_within_one_turn():
    turns = 2.0 * np.pi * np.arange(5)
    sections = {"rod.theta": np.stack([turns + 3.1, turns - 3.1]), "rod.omega": np.ones((2, 5))}
    described = [Channel("rod.theta", "rad", "angle"), Channel("rod.omega", "rad/s", "rate")]
    spun = replace(bifurcation(points=2, record=5), observables=described, section_values=sections)
    (axes,) = drawn_with(spun, "bifurcation", None).axes
    (marks,) = marks_of(axes).values()
    expected = np.repeat([3.1, 2.0 * np.pi - 3.1], 5)  # on both sides of pi, not of its ends
    np.testing.assert_allclose(marks[:, 1], expected, rtol=1e-12)  # rounding of some turns
    assert axes.get_ylabel() == "rod.theta [rad]"
    still = replace(spun, section_values={**sections, "rod.theta": np.array([[4.0] * 5] * 2)})
    (axes,) = drawn_with(still, "section", Selection(start=0, stop=1)).axes
    (marks,) = marks_of(axes).values()
    np.testing.assert_array_equal(marks[:, 0], 4.0)  # nothing turns: as it is


def test_verdicts_colour_the_sections_of_an_ensemble():
    source = replace(one_point("ensemble", 4, record=5), verdicts=np.array([1, 3, 3, 1]))
    axes, _ = drawn_with(source, "section", None).axes
    marks = marks_of(axes)
    x = source.section_values["left.eccentricity_x"] * 1e3
    np.testing.assert_allclose(marks[colours.PERIODIC.upper()][:, 0], x[[0, 3]].ravel())
    np.testing.assert_allclose(marks[colours.CHAOTIC.upper()][:, 0], x[[1, 2]].ravel())


@pytest.mark.parametrize(
    ("source", "name", "selection", "says", "cause"),
    [
        (sweep(), "bifurcation", None, "of kind bifurcation", "name"),
        (sweep(), "section", None, "not of a sweep", "name"),
        (bifurcation(points=3), "sweep", None, "kept extremes", "name"),
        (
            sweep(),
            "sweep",
            Selection(channels=("stroke", "left.contact_share")),
            "extremes or statistics",
            "channels",
        ),
        (
            sweep(),
            "sweep",
            Selection(channels=("left.contact_shear",)),
            r"did you mean left\.contact_share",
            "channels",
        ),
        (bifurcation(points=3), "section", None, "Choose one point", "start"),
        (bifurcation(points=3), "bifurcation", Selection(start=3), "points 0 to 2", "start"),
        (bifurcation(points=3), "bifurcation", Selection(stop=4), "points 0 to 2", "stop"),
        (
            bifurcation(points=3),
            "bifurcation",
            Selection(channels=("block.X",)),
            r"did you mean block\.x",
            "channels",
        ),
        (bifurcation(points=3), "bifurcation", Selection(joints=("left",)), "joints", "joints"),
        (bifurcation(points=3), "bifurcation", Selection(start=1.5), "from 0", "start"),
        (one_point(), "section", Selection(joints=("right",)), "joint 'right'", "joints"),
        (one_point(), "section", Selection(channels=("block.x",)), "two channels", "channels"),
    ],
)
def test_what_cannot_be_shown_is_said(source, name, selection, says, cause):
    with pytest.raises(NotDrawable, match=says) as caught:
        figures.draw(source, name, selection)
    assert caught.value.cause == cause


def test_an_unknown_figure_is_refused_with_those_there_are():
    with pytest.raises(UnknownFigure, match="there are sweep, every stored channel"):
        figures.draw(sweep(), "orbit")
    with pytest.raises(UnknownFigure, match="there are bifurcation, section, every"):
        figures.draw(bifurcation(points=3), "orbit")  # of one point, which is to be chosen


def test_a_study_before_its_first_result_is_drawn_empty():
    waiting = bifurcation(points=10, unfinished=range(10))
    assert figures.render(waiting, "bifurcation", "png")
    assert figures.render(sweep((5,), unfinished=range(5)), "sweep", "png")
    assert figures.render(sweep((3, 3), unfinished=range(9)), "sweep", "png")


def test_a_study_of_one_observable_without_rate_is_drawn():
    source = bifurcation(points=5)
    alone = replace(source, observables=(Channel("block.x", "m", "position"),))
    assert figures.required(alone, "bifurcation") == ("block.x",)


def test_long_numbers_of_a_section_stand_apart():
    """Values that differ in their fourth digit have labels of seven signs."""
    source = one_point(record=100)
    near = 4.9937e-4 + 8.2e-4 * source.section_values["left.eccentricity_x"]
    moved = {**source.section_values, "left.eccentricity_x": near}
    with page.style():
        figure = figures.draw(replace(source, section_values=moved), "section", None)
        saving.save(figure, "png")
        figure.draw_without_rendering()
        stand_apart(figure)


@pytest.mark.parametrize("name", ["exponents", "block.x"])
def test_an_exponent_without_bounds_has_a_bar_over_the_whole_height(name):
    source = bifurcation(points=5, judged=True)
    bounded = drawn_with(source, name, None).axes[-1].get_ylim()
    source.indicators["lyapunov_error"][3] = np.inf  # of a few sections only
    exponents = drawn_with(source, name, None).axes[-1]
    assert exponents.get_ylim() == pytest.approx(bounded, rel=0.2)
    bars = [bar for bars in exponents.collections for bar in bars.get_segments()]
    whole = [bar[:, 0] for bar in bars if sorted(bar[:, 1]) == [0.0, 1.0]]
    np.testing.assert_allclose(whole, [[source.values[3, 0] * 1e3] * 2])


def test_exponents_alone_are_drawn_with_their_verdicts():
    source = bifurcation(points=60, judged=True)
    (axes,) = drawn_with(source, "exponents", None).axes
    shown = marks_of(axes)
    for verdict, colour in ((1, colours.PERIODIC), (3, colours.CHAOTIC)):
        chosen = source.verdicts == verdict
        np.testing.assert_array_equal(
            shown[colour.upper()][:, 1], source.indicators["lyapunov"][chosen]
        )
    source.verdicts[:] = 1
    (legend,) = drawn_with(source, "exponents", None).legends
    assert [text.get_text() for text in legend.get_texts()] == ["periodic"]
    with pytest.raises(NotDrawable, match="no exponents"):
        figures.draw(bifurcation(points=3), "exponents")
    with pytest.raises(NotDrawable, match="over one parameter"):
        figures.draw(one_point(), "exponents")
