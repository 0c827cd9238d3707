"""Rare values, long names and contacts, which pictures must not lose."""

from dataclasses import replace

import numpy as np
import pytest
from closed_form_motion import closed_form_motion
from drawn import drawn_with, visible_texts

from jointplay import figures
from jointplay.figures import Selection, UnknownFigure, page

MOTION = closed_form_motion()


def test_a_histogram_shows_rare_values_beside_a_value_that_is_nearly_always_there():
    spikes = np.where(np.arange(len(MOTION.time)) % 499 == 7, 50.0 + MOTION.time, 0.0)
    rare = replace(MOTION, values=MOTION.values | {"stroke": spikes})
    (axes,) = drawn_with(rare, "histogram", Selection(channels=("stroke",))).axes
    assert axes.get_yscale() == "log"
    heights, _, _ = axes.patches[0].get_data()
    assert heights[heights > 0.0].min() > axes.get_ylim()[0]
    (even,) = figures.draw(MOTION, "histogram", Selection(channels=("stroke",))).axes
    assert even.get_yscale() == "linear"


def test_the_portrait_of_a_joint_is_wide_where_its_journal_is_in_contact():
    with page.style():
        axes, _ = figures.draw(MOTION, "phase-portrait", Selection(joints=("left",))).axes
    path, touching = axes.lines[:2]
    assert (path.get_label(), touching.get_label()) == ("trajectory", "in contact")
    wide = np.isfinite(touching.get_ydata())
    assert 0 < wide.sum() < len(wide)
    np.testing.assert_array_equal(touching.get_ydata()[wide], path.get_ydata()[wide])


def test_titles_of_loops_stay_on_the_page_however_long_the_name():
    other, long = MOTION.joints[1], "ram-guide.corner_4"  # of the panel on the right

    def named(name):
        return name.replace(f"{other}.", f"{long}.")

    contacts = MOTION.contacts.copy()
    for field in ("onset", "release"):
        contacts[field] += 0.123457
    renamed = replace(
        MOTION,
        time=MOTION.time + 0.123457,
        contacts=contacts,
        values={named(name): values for name, values in MOTION.values.items()},
        channels=[channel._replace(name=named(channel.name)) for channel in MOTION.channels],
        joints=(MOTION.joints[0], long),
    )
    figure = drawn_with(renamed, "impact-loop", None)
    titles = [text for text in visible_texts(figure) if text.get_text().endswith("dissipated")]
    assert any(long in text.get_text() for text in titles)
    width = figure.get_window_extent().x1
    assert all(text.get_window_extent().x1 <= width for text in titles)


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("orbt", "did you mean 'orbit'?"),
        ("left.normal_forc", "did you mean 'left.normal_force'?"),
        ("x", "there are"),
    ],
)
def test_a_figure_that_there_is_not_is_answered_with_the_nearest(name, said):
    with pytest.raises(UnknownFigure) as caught:
        figures.draw(MOTION, name)
    assert said in str(caught.value)
