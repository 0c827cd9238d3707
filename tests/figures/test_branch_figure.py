"""Figures of branches: stable orbits are full lines, unstable ones dashed, special ones named."""

from dataclasses import replace

import numpy as np
import pytest
from branches import HEIGHTS, NOTE, folded, over_two_parameters
from drawn import drawn_with, visible_texts

from jointplay import figures
from jointplay.figures import NotDrawable, Selection
from jointplay.records.branch import CURVES, branches
from jointplay.records.point import PointStatus


def test_stable_orbits_are_full_and_unstable_ones_dashed():
    (axes,) = drawn_with(folded(), "branch", None).axes
    full, dashed = axes.lines[:2]
    assert (full.get_linestyle(), dashed.get_linestyle()) == ("-", "--")
    factor = full.get_ydata()[0] / HEIGHTS[0]
    assert full.get_ydata() == pytest.approx(factor * HEIGHTS[:3])
    assert dashed.get_ydata() == pytest.approx(factor * HEIGHTS[2:])  # without a gap


def test_special_orbits_are_named_at_their_places_but_ends_are_not():
    (axes,) = drawn_with(folded(), "branch", None).axes
    assert [one.get_text() for one in axes.texts] == ["LP", "MX"]
    assert axes.texts[0].xy == pytest.approx((-1.0, 0.0))


def test_special_orbits_have_their_notes_and_ends_what_their_label_says():
    first, second = branches(folded())
    assert [(one.row, one.label, one.note) for one in first.special] == [
        (0, "EP", "end"),
        (2, "LP", NOTE),
        (4, "MX", "lost here"),
    ]
    assert (first.special[1].value, first.special[1].bound) == (-1.0, 1e-6)
    assert (len(second.column("value")), second.special) == (0, ())


def test_sections_of_a_branch_are_of_all_values_of_its_parameter():
    names = ("state.mass.s", "multiplier_1.real")
    figure = drawn_with(folded(), "section", Selection(channels=names, start=0, stop=1))
    shown = [text.get_text() for text in visible_texts(figure)]
    assert "speed = -1 to 3 rad/s, 5 orbits" in shown


@pytest.mark.parametrize("name", ["branch", "multipliers", "curves"])
def test_branches_that_are_not_there_are_counted(name):
    source = over_two_parameters() if name == "curves" else folded()
    status = [PointStatus.done, PointStatus.failed, PointStatus.running, PointStatus.done]
    source = replace(
        source,
        values=np.zeros((4, source.values.shape[1])),
        status=np.array(status, np.uint8),
        times=source.times[[0, 1, 0, 0]],
        section_values={one: rows[[0, 1, 0, 0]] for one, rows in source.section_values.items()},
    )
    told = "1 of 4 branches failed. 1 of 4 branches have not ended."
    assert drawn_with(source, name, None).get_supxlabel().replace("\n", " ").endswith(told)
    whole = drawn_with(source, name, Selection(start=0, stop=1 + (name == "curves")))
    assert "not ended" not in whole.get_supxlabel()
    assert ("failed" in whole.get_supxlabel()) == (name == "curves")


def test_what_has_no_branch_is_not_drawn():
    nothing = folded()
    nothing.times[:] = np.nan
    with pytest.raises(NotDrawable, match="No orbit"):
        figures.draw(nothing, "branch")


def test_a_branch_without_orbits_leaves_no_line_and_alone_is_not_drawn():
    (axes,) = drawn_with(folded(), "branch", None).axes
    assert all(len(line.get_xdata()) for line in axes.lines)
    with pytest.raises(NotDrawable, match="No orbit"):
        figures.draw(folded(), "branch", Selection(start=1, stop=2))


def test_curves_are_drawn_over_both_parameters_in_their_order_with_their_cusps():
    (axes,) = drawn_with(over_two_parameters(), "curves", None).axes
    order = [4, 3, 0, 1, 2]
    line = axes.lines[0]
    assert line.get_label() == "LP fold"
    assert line.get_xdata() == pytest.approx(HEIGHTS[order] ** 3)
    assert line.get_ydata() == pytest.approx(HEIGHTS[order] ** 2)
    assert [one.get_text() for one in axes.texts] == ["CP"]
    assert axes.get_ylabel() == "width [m]"
    assert [one.of for one in branches(over_two_parameters())] == ["", "LP"]


@pytest.mark.parametrize("label", CURVES)
def test_curves_of_every_label_are_drawn_and_named(label: str):
    found = over_two_parameters()
    labels = {
        label if one == "LP" else one: told for one, told in found.attributes["labels"].items()
    }
    renamed = replace(found, attributes=found.attributes | {"labels": labels})
    (axes,) = drawn_with(renamed, "curves", None).axes
    assert axes.lines[0].get_label().startswith(f"{label} ")


def test_the_figure_of_branches_leaves_curves_out_and_without_curves_there_is_no_figure():
    (axes,) = drawn_with(over_two_parameters(), "branch", None).axes
    alone = drawn_with(folded(), "branch", None).axes[0]
    assert len(axes.lines) == len(alone.lines)
    with pytest.raises(NotDrawable, match="No orbit"):
        figures.draw(over_two_parameters(), "branch", Selection(start=1, stop=2))
    with pytest.raises(NotDrawable, match="with 'second'"):
        figures.draw(folded(), "curves")
    with pytest.raises(NotDrawable, match="No curve"):
        figures.draw(over_two_parameters(), "curves", Selection(start=0, stop=1))


def test_names_of_close_special_orbits_lie_apart_and_those_at_one_place_together():
    crowded = folded()
    rows = crowded.section_values
    rows["state.mass.s"][0] = np.array([2.0, 0.16, 0.0, 0.02, -2.0])  # of 4: 4 and 0.5 % apart
    rows["value"][0] = np.array([3.0, -1.0, -1.0, -1.0, 3.0])
    rows["label"][0] = np.array([1.0, 2.0, 3.0, 2.0, 1.0])  # EP, MX, LP, MX, EP
    (axes,) = drawn_with(crowded, "branch", None).axes
    assert [one.get_text() for one in axes.texts] == ["MX", "LP, MX"]
    first, second = (one.get_window_extent() for one in axes.texts)
    assert not first.overlaps(second)
