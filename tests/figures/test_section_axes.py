"""Axes of sections: what they leave out, and where they say so."""

from dataclasses import replace

import numpy as np
from closed_form_study import SCENE, one_point
from drawn import drawn_with

from jointplay.figures import Selection


def held_at(level: float, channel: str = "left.eccentricity_x"):
    """Sections where a channel is at a level, but for the rounding of their location."""
    source = one_point()
    rounding = 1e-17 * np.sin(np.arange(source.record))[None, :]
    return replace(
        source,
        attributes={"job": {"kind": "poincare", "section": {"channel": channel, "value": level}}}
        | {"scene": SCENE},
        section_values=dict(source.section_values) | {channel: level + rounding},
    )


def test_a_section_leaves_out_the_coordinate_that_it_holds():
    drawn = drawn_with(held_at(0.0), "section", None)
    assert [axes.get_xlabel() for axes in drawn.axes] == ["eccentricity y [mm]"]
    # if it is asked for, its axis shows the level, not the rounding
    asked = ("left.eccentricity_x", "left.eccentricity_rate_x")
    (axes,) = drawn_with(held_at(1e-4), "section", Selection(channels=asked)).axes
    low, high = axes.get_xlim()
    assert high - low > 1e-3 * abs(high)


def test_what_an_axis_leaves_out_of_its_numbers_stands_in_its_label():
    source = one_point()
    name = "left.eccentricity_x"
    close = dict(source.section_values) | {name: 1.0 + 1e-6 * source.section_values[name]}
    figure = drawn_with(replace(source, section_values=close), "section", None)
    axes = figure.axes[0]
    assert not axes.xaxis.get_offset_text().get_visible()
    assert axes.get_xlabel().startswith("eccentricity x [")
    assert axes.get_xlabel().endswith(axes.xaxis.get_major_formatter().get_offset())
    assert axes.xaxis.get_major_formatter().get_offset()
