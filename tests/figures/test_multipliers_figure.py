"""The figure of multipliers: where they are, their colours, what lies outside."""

import numpy as np
import pytest
from branches import REAL, folded
from closed_form_study import sweep
from drawn import drawn_with

from jointplay import figures
from jointplay.figures import NotDrawable


def test_multipliers_stand_at_their_places_and_far_ones_are_told_of():
    drawn = drawn_with(folded(), "multipliers", None)
    axes = drawn.axes[0]
    (points,) = axes.collections
    assert {tuple(one) for one in points.get_offsets().tolist()} == {
        (0.2, 0.3),
        (0.5, 0.3),
        (1.0, 0.0),
        (1.5, 0.0),
        *((0.5 * one, -0.3 if one < 1.0 else 0.0) for one in REAL),
    }
    told = "1 of 5 orbits have a multiplier beyond 3, which is not drawn. 1 of 2 branches failed."
    assert drawn.get_supxlabel().replace("\n", " ") == told
    circle = axes.lines[0]
    assert np.hypot(circle.get_xdata(), circle.get_ydata()) == pytest.approx(1.0)


def test_they_are_those_of_a_continuation_alone():
    with pytest.raises(NotDrawable, match="kind continuation"):
        figures.draw(sweep(), "multipliers")
