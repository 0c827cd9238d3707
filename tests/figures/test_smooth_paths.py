"""Paths between coarse samples are what the motion is there, as far as samples can tell."""

from dataclasses import replace

import numpy as np
from closed_form_motion import SCENE
from drawn import drawn_with

from jointplay.figures import Selection
from jointplay.records.channel import Channel
from jointplay.records.impact import IMPACT
from jointplay.records.run import Dataset


def thrown(samples, contacts=()):
    """A journal in free flight under constant acceleration, sampled coarsely."""
    time = np.linspace(0.0, 0.1, samples)
    names = ["left.eccentricity_x", "left.eccentricity_y"]
    rates = ["left.eccentricity_rate_x", "left.eccentricity_rate_y"]
    columns = [2e-3 * time, 4e-3 * time - 5e-2 * time**2]
    columns += [np.full_like(time, 2e-3), 4e-3 - 1e-1 * time]
    rows = np.zeros(len(contacts), IMPACT)
    rows["onset"], rows["release"] = contacts, np.asarray(contacts) + 1e-4
    channels = [Channel(name, "m", "") for name in names]
    channels += [Channel(name, "m/s", "") for name in rates]
    return Dataset(
        {"scene": SCENE},
        channels,
        time,
        dict(zip(names + rates, columns, strict=True)),
        contacts=rows,
        joints=("left", "right"),
    )


def test_free_flight_between_coarse_samples_is_drawn_as_the_parabola_it_is():
    (axes,) = drawn_with(thrown(5), "orbit", Selection(joints=("left",))).axes
    x, y = axes.lines[0].get_data()
    assert len(x) > 40
    np.testing.assert_allclose(y, 2.0 * x - 12.5 * x**2, atol=1e-12)  # both in mm
    coarse = thrown(5)
    without = replace(coarse, channels=[one for one in coarse.channels if one.unit == "m"])
    (axes,) = drawn_with(without, "orbit", Selection(joints=("left",))).axes
    assert len(axes.lines[0].get_xdata()) == 5  # positions alone are joined straight


def test_between_samples_that_a_contact_parts_the_path_is_straight():
    (axes,) = drawn_with(thrown(5, [0.03]), "orbit", Selection(joints=("left",))).axes
    x, y = axes.lines[0].get_data()
    inside = (x > 0.05) & (x < 0.1)  # mm: the second of four intervals
    slope = np.diff(y[inside]) / np.diff(x[inside])
    np.testing.assert_allclose(slope, slope[0])
    outside = (x > 0.1) & (x < 0.15)
    np.testing.assert_allclose(y[outside], 2.0 * x[outside] - 12.5 * x[outside] ** 2, atol=1e-12)
