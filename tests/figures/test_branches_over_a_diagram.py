"""Branches of periodic orbits over the sections of a bifurcation diagram."""

from dataclasses import replace

import numpy as np
import pytest
from branches import HEIGHTS, folded
from drawn import drawn_with

from jointplay import figures
from jointplay.figures import NotDrawable, Selection
from jointplay.records.channel import Channel
from jointplay.records.point import PointStatus
from jointplay.records.study import StudyDataset

SPEEDS = np.array([0.0, 1.0, 2.0, 3.0])


def seen(unit="m", turns=0.0):
    """Return the branch of `folded` with a channel at its sections."""
    found = folded()
    rows = found.section_values["state.mass.s"] + 2.0 * np.pi * turns
    return replace(
        found,
        observables=(*found.observables, Channel("mass.x", unit, "position")),
        section_values={**found.section_values, "mass.x": rows},
    )


def diagram(parameter="speed", channel="mass.x", unit="m"):
    """Return the diagram of the upper half of that branch: two equal sections at each speed."""
    heights = np.sqrt(SPEEDS + 1.0)
    return StudyDataset(
        attributes={
            "job": {"kind": "bifurcation"},
            "scene": {"name": "", "bodies": {}, "joints": {}},
        },
        parameters=(Channel(parameter, "rad/s", parameter),),
        values=SPEEDS[:, None],
        status=np.full(len(SPEEDS), PointStatus.done, np.uint8),
        observables=(Channel(channel, unit, "position"),),
        times=np.zeros((len(SPEEDS), 2)),
        section_values={channel: np.repeat(heights[:, None], 2, axis=1)},
    )


def test_stable_orbits_lie_on_the_sections():
    axes = drawn_with(seen(), "branch", Selection(over=diagram())).axes[0]
    cloud, full, dashed = axes.lines[:3]
    assert cloud.get_xdata() == pytest.approx(np.repeat(SPEEDS, 2))
    assert cloud.get_label() == "sections"
    assert (full.get_linestyle(), dashed.get_linestyle()) == ("-", "--")
    assert full.get_xdata() == pytest.approx(HEIGHTS[:3] ** 2 - 1.0)
    assert full.get_ydata() == pytest.approx(HEIGHTS[:3])
    at = dict(zip(cloud.get_xdata(), cloud.get_ydata(), strict=True))
    assert at[3.0] == pytest.approx(full.get_ydata()[0])
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("speed [rad/s]", "mass.x [m]")


def test_angles_of_orbits_are_within_the_turn_of_the_sections():
    axes = drawn_with(seen("rad", turns=3.0), "branch", Selection(over=diagram(unit="rad"))).axes[0]
    assert axes.lines[1].get_ydata() == pytest.approx(HEIGHTS[:3])


def test_a_diagram_without_sections_yet_lies_beneath_too():
    waiting = diagram(unit="rad")
    waiting.section_values["mass.x"][:] = np.nan
    axes = drawn_with(seen("rad"), "branch", Selection(over=waiting)).axes[0]
    assert axes.lines[1].get_ydata() == pytest.approx(HEIGHTS[:3])


@pytest.mark.parametrize(
    ("over", "channels", "says", "cause"),
    [
        (diagram("width"), (), "The diagram is over width, these orbits over speed", "over"),
        (diagram(channel="mass.y"), (), "no channel in common", "over"),
        (diagram(), ("multiplier_1.real",), "no channel 'multiplier_1.real'", "channels"),
    ],
)
def test_what_cannot_lie_beneath_is_said(over, channels, says, cause):
    with pytest.raises(NotDrawable, match=says) as refusal:
        figures.draw(seen(), "branch", Selection(channels=channels, over=over))
    assert refusal.value.cause == cause


def test_orbits_that_all_lie_beyond_the_values_are_refused():
    far = replace(diagram(), values=diagram().values + 100.0)
    with pytest.raises(NotDrawable, match="No orbit lies within the values") as refused:
        figures.draw(seen(), "branch", Selection(over=far))
    assert refused.value.cause == "over"
