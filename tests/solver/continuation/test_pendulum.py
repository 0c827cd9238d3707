"""Period doublings of a damped driven pendulum, beside those known."""

import pytest

from benchmarks.known_orbits import DOUBLINGS, followed, pendulum


def test_a_pendulum_doubles_four_times_where_it_is_known_to() -> None:
    """Behind the third doubling differences tell a multiplier of -0.32 to 0.24: it is stable."""
    job = {
        "scene": pendulum(),
        "parameter": "strength",
        "values": {"from": 1.06, "to": 1.084, "count": 60},
        "settle": 200,
        "doublings": 3,
        "tolerance": 1e-12,
    }
    found = [[one for one in branch.special if one.label == "PD"] for branch in followed(job)]
    (first,), (second,), (third,), (fourth,) = found
    assert first.value == pytest.approx(DOUBLINGS[0], abs=1e-9)
    assert second.value == pytest.approx(DOUBLINGS[1], abs=2e-8)
    assert third.value == pytest.approx(DOUBLINGS[2], abs=1e-7)
    assert fourth.value == pytest.approx(DOUBLINGS[3], abs=1e-7)
    assert third.bound < 1e-6
