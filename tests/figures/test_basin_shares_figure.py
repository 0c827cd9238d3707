"""Figures of drawn starts: shares stand on one another over a parameter, or beside one another."""

import numpy as np
import pytest
from drawn import drawn_with
from matplotlib.colors import to_hex

from jointplay.figures import NotDrawable
from jointplay.records.attractors import colour_of_attractor
from jointplay.records.motion import NAMES
from jointplay.records.share_error import share_error
from tests.starts_by_hand import study


def over(values, places):
    return study([1] * len(places), [[x, 0.0] for x in places], along=values)


def test_shares_stand_on_one_another_with_their_errors():
    source = over([1.0] * 4 + [2.0] * 4, [-1.0, 1.0, 1.0, 1.0, -1.0, -1.0, 1.0, 1.0])
    (axes,) = drawn_with(source, "basin-stability", None).axes
    assert axes.get_xlabel() == "push [N·m]"
    lower, upper = [bars for bars in axes.containers if hasattr(bars, "patches")]
    assert [bar.get_height() for bar in lower] == pytest.approx([0.25, 0.5])
    assert [bar.get_y() for bar in upper] == pytest.approx([0.25, 0.5])
    assert [bar.get_y() + bar.get_height() for bar in upper] == pytest.approx([1.0, 1.0])
    (lines,) = [
        one
        for bars in axes.containers
        if hasattr(bars, "lines")
        for one in bars.lines[2]
        if len(one.get_segments())
    ]
    lengths = [np.ptp(segment[:, 1]) for segment in lines.get_segments()]
    assert lengths == pytest.approx([2.0 * share_error(3, 4), 2.0 * share_error(2, 4)])


def test_without_a_parameter_each_attractor_has_a_bar():
    source = over([1.0] * 4, [-1.0, 1.0, 1.0, 1.0])
    (axes,) = drawn_with(source, "basin-stability", None).axes
    bars = next(bars for bars in axes.containers if hasattr(bars, "patches"))
    assert [bar.get_width() for bar in bars] == pytest.approx([0.25, 0.75])
    assert [label.get_text() for label in axes.get_yticklabels()] == ["period-1 A", "period-1 B"]
    colours = [to_hex(bar.get_facecolor()) for bar in bars]
    assert colours == [colour_of_attractor(len(NAMES)), colour_of_attractor(len(NAMES) + 1)]


def test_of_a_map_shares_are_not_drawn():
    with pytest.raises(NotDrawable, match="basin-stability"):
        drawn_with(study([1], [[0.0, 0.0]]), "basin-stability", None)


def test_before_a_start_has_ended_there_is_nothing_to_draw():
    source = over([1.0], [0.0])
    source.status[:] = 0
    with pytest.raises(NotDrawable, match="No start has ended"):
        drawn_with(source, "basin-stability", None)
