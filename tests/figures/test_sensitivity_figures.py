"""Figures of sensitivities: bars and intervals are the measures that the answer has."""

import numpy as np
import pytest
from closed_form_study import sensitivity as study
from closed_form_study import sweep
from drawn import drawn_with

from jointplay import figures
from jointplay.figures import NotDrawable, Selection
from jointplay.records.sensitivity.analysis import Question, sensitivity

BARS = {
    "saltelli": ("first_order", "total"),
    "morris": ("mean_magnitude", "spread"),
    "latin-hypercube": ("rank_correlation",),
}


@pytest.mark.parametrize("design", BARS)
def test_bars_are_measures_and_lines_their_intervals(design):
    source = study(design)
    found = sensitivity(source, Question("block.x.maximum"))["measures"]
    (axes,) = drawn_with(source, "sensitivity", None).axes
    factor = 1e-3 if design == "morris" else 1.0
    assert axes.get_xlabel().endswith(" [mm]") == (design == "morris")
    assert [label.get_text() for label in axes.get_yticklabels()] == [
        f"clearance_{number}" for number in range(3)
    ]
    bars, lines = axes.containers[::2], axes.containers[1::2]
    middles = [[bar.get_y() + 0.5 * bar.get_height() for bar in drawn] for drawn in bars]
    assert np.mean(middles, axis=0) == pytest.approx(axes.get_yticks())
    for name, drawn, reach in zip(BARS[design], bars, lines, strict=True):
        widths = [bar.get_width() * factor for bar in drawn]
        assert widths == pytest.approx(found[name]["values"], abs=1e-12)
        ((*segments,),) = (lines.get_segments() for lines in reach.lines[2])
        ends = np.array([segment[:, 0] for segment in segments]) * factor
        assert ends[:, 0] == pytest.approx(found[name]["low"], abs=1e-12)
        assert ends[:, 1] == pytest.approx(found[name]["high"], abs=1e-12)


def test_of_many_parameters_those_of_the_longest_bars_are_drawn():
    (axes,) = drawn_with(study(parameters=30), "sensitivity", None).axes
    names = [label.get_text() for label in axes.get_yticklabels()]
    assert len(names) == 20
    assert names[:4] == [f"clearance_{number}" for number in range(4)]


def test_the_name_of_an_output_or_a_channel_is_its_figure():
    source = study(failed=(7,))
    for name, title in (
        ("block.x.range", "block.x.range"),
        ("block.x", "block.x.maximum"),
        ("left.contact_share", "left.contact_share"),
    ):
        figure = drawn_with(source, name, None)
        assert figure.axes[0].get_title("left") == title
    noted = sensitivity(source, Question("left.contact_share"))["note"]
    assert noted.startswith("In 1 of 64 rows a point failed")
    assert f"63 rows. {noted}" in _caption(figure)
    assert [one.name for one in figures.available(source)] == ["sensitivity"]


@pytest.mark.parametrize("design", BARS)
def test_a_figure_says_that_bars_may_be_of_errors_of_the_runs(design):
    source = study(design)
    source.attributes["job"]["tolerance"] = 1e-3
    noted = sensitivity(source, Question("block.x.maximum"))["note"]
    assert "errors of the runs" in noted
    assert noted in _caption(drawn_with(source, "sensitivity", None))


def _caption(figure):
    return figure.get_supxlabel().replace("\n", " ")


def test_what_has_none_is_not_drawn():
    with pytest.raises(NotDrawable, match="no parameter matters"):
        figures.draw(study(constant=True), "sensitivity")
    with pytest.raises(NotDrawable, match="of a job of kind sensitivity"):
        figures.draw(sweep(), "sensitivity")
    with pytest.raises(NotDrawable, match="at most 1 outputs"):
        figures.draw(study(), "sensitivity", Selection(channels=("block.x", "left.contact_share")))
