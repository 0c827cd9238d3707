"""Figures of branches: stable orbits are full lines, unstable ones dashed, special ones named."""

import numpy as np
import pytest
from branches import HEIGHTS, NOTE, folded
from drawn import drawn_with

from jointplay import figures
from jointplay.figures import NotDrawable, Selection
from jointplay.records.branch import branches


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
