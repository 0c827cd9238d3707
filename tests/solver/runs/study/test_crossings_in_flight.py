"""Sections at a value are taken at every crossing, also at several in one long step."""

import math
from typing import Any

import numpy as np
import pytest

from tests.solver.completed_runs import run
from tests.solver.runs.study.test_run import Computed

JOURNAL = {
    "preset": "bouncing-journal",
    "parameters": {"velocity_x": 0.3, "gravity_y": -1.0, "friction": 0.05, "position_y": 1e-4},
}


def sections(scene: dict[str, Any], channel: str, value: float, record: int) -> Computed:
    """Return the sections where a channel comes to a value from below."""
    section = {"channel": channel, "value": value, "direction": "up"}
    job = {"kind": "poincare", "scene": scene, "settle": 0, "record": record, "section": section}
    return Computed({**job, "observables": [channel]})


@pytest.mark.parametrize(
    ("channel", "value", "record"),
    [("bearing.penetration", -0.000827479, 12), ("bearing.slip_velocity", -0.145, 7)],
)
def test_a_journal_crosses_as_often_as_its_samples(channel: str, value: float, record: int) -> None:
    found = sections(JOURNAL, channel, value, record)
    times = np.concatenate(found.times[0])
    assert np.all(np.abs(found.sections(0)[:, 0] - value) < 1e-9 * abs(value))
    last = float(times[-1])
    sampled = run(
        "bouncing-journal", last, parameters=JOURNAL["parameters"], output_step=last / 1e5
    )
    beyond = sampled[channel] >= value
    crossed = sampled.time[1:][beyond[1:] & ~beyond[:-1]]
    assert len(times) - 1 <= len(crossed) <= len(times)  # the last sample may be just before one
    np.testing.assert_allclose(times[: len(crossed)], crossed, atol=1.1 * last / 1e5)


def test_an_angle_crosses_a_value_once_a_turn() -> None:
    scene = {"preset": "pendulum", "parameters": {"angular_velocity": 30.0}}
    found = sections(scene, "rod.theta", 0.5, 20).sections(0)[:, 0]
    turns = (found - 0.5) / (2.0 * np.pi)
    np.testing.assert_allclose(turns, np.round(turns), atol=1e-12)
    assert np.all(np.diff(np.round(turns)) == 1.0)


@pytest.mark.parametrize(
    ("channel", "value", "first"), [("crank1.theta", 1.0, 1.0), ("crank1.x", 0.0, 1.5 * np.pi)]
)
def test_a_driven_crank_crosses_when_it_has_turned_so_far(
    channel: str, value: float, first: float
) -> None:
    found = sections({"preset": "seven-bar-press"}, channel, value, 3)
    times = np.concatenate(found.times[0])
    np.testing.assert_allclose(np.pi * times, first + 2.0 * np.pi * np.arange(3), rtol=1e-12)


def test_a_slip_is_looked_at_where_a_journal_passes_the_centre_within_a_step() -> None:
    """It flies straight on, and slips by v d / r, d off the centre: hardly so at a step's ends."""
    speed, off, before = 0.3, 1e-5, 5e-4  # m/s, m, m
    flight = {"velocity_x": speed, "gravity_y": 0.0, "position_x": -before, "position_y": off}
    scene = {"preset": "bouncing-journal", "parameters": flight}
    (passed,) = sections(scene, "bearing.slip_velocity", -0.5 * speed, 1).times[0]
    assert passed == pytest.approx((before + math.sqrt(3.0) * off) / speed, rel=1e-9)  # r = 2 d
